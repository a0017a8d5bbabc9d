#include "calibration/calibrate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calibration/snooping.h"
#include "calibration/systematic.h"
#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using test::crooked;
using test::hill;
using test::just_put_up;
using test::kArcsec;
using test::landmarks_around;
using test::rejected;

double direction_error(const StationModel& truth, const StationModel& found, double pan_deg) {
  UnitReading reading;
  reading.pan.counts = pan_deg / 360.0 * 112000.0;
  reading.tilt.approach = -1;  // as all were sighted
  const auto a = predict_direction(truth, reading, {640.0, 480.0});
  const auto b = predict_direction(found, reading, {640.0, 480.0});
  return angle_between(enu_from_azimuth_elevation(a->direction),
                       enu_from_azimuth_elevation(b->direction));
}

TEST(Calibrate, FindsAStationThatLooksTheOtherWay) {
  const StationModel truth = crooked();
  const Adjustment adjustment(network_of(landmarks_around(truth, just_put_up(), 8)));
  const Calibration found = calibrate(adjustment);
  EXPECT_TRUE(found.remarks.empty());
  EXPECT_LT(found.global.variance_factor, 0.5);
  const StationModel& model = found.fit.state.stations[0].model;
  const StationMatrix C = found.covariance(adjustment.network(), 0);
  for (const double pan_deg : {-140.0, -60.0, 0.0, 100.0}) {
    EXPECT_LT(direction_error(truth, model, pan_deg), 12.0 * kArcsec) << pan_deg;
  }
  const VolumePrecision volume = volume_precision(model, C);
  EXPECT_GT(volume.rms_rad, 3.0 * kArcsec);
  EXPECT_LT(volume.rms_rad, 60.0 * kArcsec);
  EXPECT_GE(volume.worst_rad, volume.rms_rad);
}

TEST(Calibrate, NamesALandmarkThatIsOffByAMetre) {
  const StationModel truth = crooked();
  Problem problem = landmarks_around(truth, just_put_up(), 7);
  auto& place = std::get<FixedPoint>(problem.references["landmark2"]);
  place.ecef += R_ecef_enu(place.ecef) * Eigen::Vector3d(0.7, 0.7, 0.0);
  const Adjustment adjustment(network_of(problem));
  const Calibration found = calibrate(adjustment);
  EXPECT_EQ(rejected(adjustment, found), std::vector<std::string>{"landmark2"});
  EXPECT_EQ(found.remarks.size(), 1U);
}

TEST(Calibrate, TellsEachAdjustment) {
  const Problem problem = landmarks_around(crooked(), just_put_up(), 7);
  int adjustments = 0;
  calibrate(Adjustment(network_of(problem)), {}, [&] { ++adjustments; });
  EXPECT_EQ(adjustments, 1) << "nothing is rejected";
}

TEST(Calibrate, SaysSoWhereNoMajorityAgrees) {
  Problem problem = landmarks_around(crooked(), just_put_up(), 4);
  for (const char* name : {"landmark0", "landmark2"}) {
    auto& place = std::get<FixedPoint>(problem.references[name]);
    place.ecef += R_ecef_enu(place.ecef) * Eigen::Vector3d(90.0, name[8] * 3.0 - 150.0, 0.0);
  }
  const Adjustment adjustment(network_of(problem));
  EXPECT_THROW(calibrate(adjustment), Contradiction);
}

// Both look elsewhere than their configurations say, and differently, at the same landmarks.
TEST(Calibrate, StationsThatShareTheirLandmarksNeedNoHeading) {
  constexpr double kTurned_deg = 100.0;
  Problem problem = landmarks_around(hill(), just_put_up(), 8);
  problem.names.emplace_back("bravo");
  problem.stations.push_back(problem.stations.front());
  for (std::size_t i = 0; i < problem.observations.size(); i += 2) {
    problem.observations[i].station = 1;
    problem.observations[i].reading.pan.counts += std::round(kTurned_deg / 360.0 * 112000.0);
  }
  const Calibration found = calibrate(Adjustment(network_of(problem)));
  const double heading_rad = hill().geometry.chain.heading_rad;
  for (std::size_t s = 0; s < 2; ++s) {
    const double turned_rad = s == 0 ? 0.0 : radians(kTurned_deg);
    const ChainParameters& chain = found.fit.state.stations[s].model.geometry.chain;
    EXPECT_NEAR(wrap_pi(chain.heading_rad - heading_rad - turned_rad), 0.0, 100.0 * kArcsec) << s;
  }
}

TEST(Calibrate, WhatIsNoNumberIsNotAccepted) {
  Problem problem = landmarks_around(crooked(), just_put_up(), 5);
  problem.observations[2].pixel.x() = std::nan("");
  const Adjustment adjustment(network_of(landmarks_around(crooked(), just_put_up(), 5)));
  Fit fit = adjustment.fit(adjustment.start({crooked().geometry.chain.heading_rad}),
                           std::vector<bool>(5, true));
  fit.equations[0].gradient.setConstant(std::nan(""));
  EXPECT_TRUE(std::isinf(test_statistic(adjustment, fit, 0)));
  EXPECT_THROW(calibrate(Adjustment(network_of(problem))), std::invalid_argument);
}

// What scenery tells of a lens and of gears that were known by a workshop.
Problem seen_around(const StationModel& truth) {
  Problem problem = test::scenery_around(truth, 24);
  problem.stations[0].covariance.topLeftCorner<kInstrumentParameters, kInstrumentParameters>() *=
      0.01;
  return problem;
}

TEST(Calibrate, SceneryTellsTheInstrumentAlone) {
  StationModel truth = hill();
  truth.geometry.camera.fx_px *= 1.0001;
  truth.pan.backlash_rad = 3.0 * kArcsec;
  const Adjustment adjustment(network_of(seen_around(truth)));
  const Calibration found = calibrate(adjustment);
  EXPECT_FALSE(found.headings_known);
  EXPECT_EQ(found.scaled_by, 1.0);
  const StationModel& model = found.fit.state.stations[0].model;
  // Nobody knows how far the points are, which leaves some of the focal length to the prior.
  const double focal_sd_px = std::sqrt(found.covariance(adjustment.network(), 0)(kFocal, kFocal));
  EXPECT_LT(focal_sd_px, 3.0);  // 4 before
  EXPECT_NEAR(model.geometry.camera.fx_px, truth.geometry.camera.fx_px, 0.5 * focal_sd_px);
  EXPECT_NEAR(model.pan.backlash_rad, truth.pan.backlash_rad, 1.0 * kArcsec);
}

// Branches in the wind: each time elsewhere, by ten deviations and more.
TEST(Calibrate, SceneryThatMovesIsNamed) {
  for (const int moving : {3, 15}) {  // of 30
    Problem problem = test::scenery_around(hill(), 30);
    for (std::size_t i = 0; i < problem.observations.size(); ++i) {
      if (i / 4 % 30 >= static_cast<std::size_t>(moving)) continue;
      problem.observations[i].pixel.y() += i % 2 == 0 ? 2.0 : -2.0;
    }
    const Calibration found = calibrate(Adjustment(network_of(problem)));
    const bool named = std::ranges::any_of(found.remarks, [](const std::string& remark) {
      return remark.find("do not stay where they are: does it move?") != std::string::npos;
    });
    EXPECT_EQ(named, moving == 15) << moving;
  }
}

TEST(Calibrate, OnlyALevelTellsNothing) {
  Problem problem = landmarks_around(hill(), hill(), 2);
  problem.observations.resize(1);
  problem.observations[0] = {};
  problem.observations[0].kind = Kind::kInclinometer;
  problem.observations[0].tilt_sd_rad = problem.observations[0].zero_sd_rad = kArcsec;
  EXPECT_THROW(calibrate(Adjustment(network_of(problem))), std::invalid_argument);
}

}  // namespace
}  // namespace ols::calibration
