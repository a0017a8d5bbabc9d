#include "calibration/acceptance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using Judgement = Finding::Judgement;
using test::hill;
using test::just_put_up;
using test::landmarks_around;

Acceptance judged(const Problem& problem) {
  const Adjustment adjustment(network_of(problem));
  const Calibration found = calibrate(adjustment);
  return judge_calibration(problem, adjustment, found, 0);
}

const Finding& finding(const Acceptance& acceptance, const std::string& name) {
  const auto found = std::ranges::find(acceptance.findings, name, &Finding::name);
  EXPECT_NE(found, acceptance.findings.end()) << name;
  return *found;
}

// Landmarks all around, a workshop's unit, none of them wrong.
Problem good() {
  Problem problem = landmarks_around(hill(), just_put_up(), 9);
  problem.stations[0].covariance.topLeftCorner<kInstrumentParameters, kInstrumentParameters>() *=
      0.01;
  return problem;
}

// Twice more, a landmark above all others, so many metres below where it is said to be.
void add_high(Problem& problem, double pan_deg, double tilt_deg, double off_m) {
  const Observation high = test::landmark(pan_deg, tilt_deg, "high");
  FixedPoint place = test::place_seen(hill(), high, 1000.0);
  place.ecef += R_ecef_enu(place.ecef) * Eigen::Vector3d(0.0, 0.0, off_m);
  problem.references["high"] = place;
  for (int k = 0; k < 2; ++k) problem.observations.push_back(high);
}

TEST(Acceptance, NamesWhatIsGood) {
  const Acceptance acceptance = judged(good());
  for (const Finding& one : acceptance.findings) {
    EXPECT_NE(one.judgement, Judgement::kBad) << one.sentence;
  }
  EXPECT_TRUE(acceptance.acceptable());
  EXPECT_EQ(finding(acceptance, "systematic_rms").judgement, Judgement::kGood);
  EXPECT_EQ(finding(acceptance, "sectors").judgement, Judgement::kGood);
  EXPECT_EQ(finding(acceptance, "closing").judgement, Judgement::kGood);
  // They stand within 8 degrees of elevation.
  EXPECT_TRUE(acceptance.volume_is_cut);
  EXPECT_LT(acceptance.volume.highest_deg, 15.0);
  EXPECT_EQ(acceptance.volume.pan_deg, 150.0);
}

// What moved between the first and the last sighting of a landmark shows in the closing.
TEST(Acceptance, FindsATripodThatMovedMeanwhile) {
  Problem problem = good();
  problem.observations[1].pixel.x() += 3.0;  // the second sighting of landmark0: 46 arc seconds
  const Finding closing = finding(judged(problem), "closing");
  EXPECT_EQ(closing.judgement, Judgement::kBad);
  EXPECT_NEAR(closing.value, 46.4, 3.0);
}

// A mistaken sighting that was rejected says nothing of the others, and nothing of its sector.
TEST(Acceptance, WhatIsRejectedCountsNowhere) {
  Problem problem = good();
  add_high(problem, 170.0, 20.0, 20.0);
  const Acceptance acceptance = judged(problem);
  EXPECT_EQ(finding(acceptance, "rejected high").judgement, Judgement::kBad);
  EXPECT_TRUE(acceptance.volume_is_cut);
  EXPECT_LT(finding(acceptance, "elevations").value, 10.0);
}

// The same landmarks at both sides of the picture, by a lens that is longer than its instrument
// says.
TEST(Acceptance, ALensThatWasRefocusedIsNoGoodCalibration) {
  StationModel truth = hill();
  truth.geometry.camera.fx_px *= 1.002;
  Problem problem = landmarks_around(truth, just_put_up(), 9);
  problem.stations[0].covariance.topLeftCorner<kInstrumentParameters, kInstrumentParameters>() *=
      0.01;
  const Problem scenery = test::scenery_around(truth, 24);
  problem.observations.insert(problem.observations.end(), scenery.observations.begin(),
                              scenery.observations.end());
  const Acceptance acceptance = judged(problem);
  EXPECT_EQ(finding(acceptance, "focal length").judgement, Judgement::kBad);
  EXPECT_FALSE(acceptance.acceptable());
}

// A landmark that is rejected, and one alone that nobody checks.
TEST(Acceptance, NamesWhatIsBadOrUnchecked) {
  Problem problem = good();
  auto& place = std::get<FixedPoint>(problem.references["landmark4"]);
  place.ecef += R_ecef_enu(place.ecef) * Eigen::Vector3d(0.0, 0.0, 3.0);
  const Acceptance with_wrong = judged(problem);
  EXPECT_FALSE(with_wrong.acceptable());
  EXPECT_EQ(finding(with_wrong, "rejected landmark4").judgement, Judgement::kBad);

  Problem alone = good();
  alone.observations.resize(2);
  const Acceptance single = judged(alone);
  EXPECT_EQ(finding(single, "detectable landmark0").judgement, Judgement::kUnchecked);
  EXPECT_EQ(finding(single, "sectors").judgement, Judgement::kUnchecked);
  EXPECT_LT(single.volume.pan_deg, 175.0);
}

// High above all others of a new unit, whose gears and axes nobody knows: they predict it as badly
// as they check it, and what they miss it by is no fault of what was found.
TEST(Acceptance, WhatTheOthersCannotPredictIsNotBad) {
  Problem problem = landmarks_around(hill(), just_put_up(), 9);
  add_high(problem, 20.0, 25.0, 0.3);
  const Acceptance acceptance = judged(problem);
  EXPECT_EQ(finding(acceptance, "detectable high").judgement, Judgement::kUnchecked);
  const Finding& angle = finding(acceptance, "without_itself high");
  EXPECT_GT(angle.value, angle.limit);
  EXPECT_EQ(angle.judgement, Judgement::kUnchecked);
  EXPECT_EQ(finding(acceptance, "without_itself_sigma high").judgement, Judgement::kGood);
}

// Numbers that the computation could not give are no reason to say "good".
TEST(Acceptance, WhatIsNotKnownIsBad) {
  const Problem problem = good();
  const Adjustment adjustment(network_of(problem));
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Calibration found = calibrate(adjustment);
    found.global.variance_factor = value;
    const Acceptance acceptance = judge_calibration(problem, adjustment, found, 0);
    EXPECT_EQ(finding(acceptance, "global_test").judgement, Judgement::kBad);
    EXPECT_FALSE(acceptance.acceptable());
  }
}

// A workshop's instrument, by scenery alone.
Acceptance judged_by_scenery(const StationModel& truth) {
  Problem problem = test::scenery_around(truth, 24);
  problem.stations[0].covariance.topLeftCorner<kInstrumentParameters, kInstrumentParameters>() *=
      0.01;
  const Adjustment adjustment(network_of(problem));
  return judge_instrument(problem, adjustment, calibrate(adjustment), 0);
}

TEST(Acceptance, SceneryFindsAnInstrumentAsItIsKnown) {
  const Acceptance acceptance = judged_by_scenery(hill());
  EXPECT_TRUE(acceptance.acceptable());
  for (const char* name : {"sweep", "focal length", "backlash of pan", "backlash of tilt"}) {
    EXPECT_EQ(finding(acceptance, name).judgement, Judgement::kGood) << name;
  }
}

TEST(Acceptance, SceneryFindsALensThatWasRefocused) {
  StationModel truth = hill();
  truth.geometry.camera.fx_px *= 1.002;  // known to 0.3 thousandths
  const Acceptance acceptance = judged_by_scenery(truth);
  EXPECT_FALSE(acceptance.acceptable());
  const Finding& focal = finding(acceptance, "focal length");
  EXPECT_EQ(focal.judgement, Judgement::kBad);
  // Of 26.7 px; the distances of the points, which nobody knows, are taken to be the rest.
  EXPECT_GT(focal.value, 13.0);
  EXPECT_LT(focal.value, 27.0);
  EXPECT_EQ(finding(acceptance, "backlash of pan").judgement, Judgement::kGood);
}

}  // namespace
}  // namespace ols::calibration
