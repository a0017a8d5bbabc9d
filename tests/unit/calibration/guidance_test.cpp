#include "calibration/guidance.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using test::hill;
using test::landmarks_around;

Candidate sighting_of(const Problem& problem, const std::string& name) {
  Candidate candidate{name, {}};
  for (const Observation& one : problem.observations) {
    if (one.reference == name) candidate.sightings.push_back(one);
  }
  return candidate;
}

// Two landmarks are sighted, side by side: the one across the horizon helps more than one beside
// them, and what is foretold is what the adjustment then says.
TEST(Guidance, ChoosesTheLandmarkThatHelpsMost) {
  const Problem all = landmarks_around(hill(), hill(), 9);
  Problem so_far = all;
  so_far.observations.resize(4);  // landmark0 and landmark1, at -140 and -105 degrees
  const std::vector<Candidate> candidates{sighting_of(all, "landmark2"),
                                          sighting_of(all, "landmark7")};
  const auto ranked = rank_sightings(so_far, 0, hill(), candidates);
  ASSERT_EQ(ranked.size(), 2U);
  EXPECT_EQ(candidates[ranked[0].candidate].name, "landmark7");
  EXPECT_LT(ranked[0].rms_rad, 0.8 * ranked[1].rms_rad);
  EXPECT_LT(ranked[0].rms_rad, planned_precision(so_far, 0, hill()).rms_rad);

  Problem with = so_far;
  for (const Observation& one : candidates[1].sightings) with.observations.push_back(one);
  const Adjustment adjustment(network_of(with));
  const Calibration found = calibrate(adjustment);
  const VolumePrecision left = volume_precision(found.fit.state.stations[0].model,
                                                found.covariance(adjustment.network(), 0));
  EXPECT_NEAR(ranked[0].rms_rad, left.rms_rad, 0.02 * left.rms_rad);
}

TEST(Guidance, LeavesOutWhatCannotBeSighted) {
  const Problem all = landmarks_around(hill(), hill(), 3);
  Candidate nowhere = sighting_of(all, "landmark0");
  nowhere.sightings[0].reference = "nowhere";
  EXPECT_TRUE(rank_sightings(all, 0, hill(), {nowhere}).empty());
}

TEST(Guidance, ReadingsBringAPointOntoThePixel) {
  const StationModel model = test::crooked();
  const HomogeneousPoint point{Eigen::Vector3d(300.0, -500.0, 60.0), 1.0};
  const Eigen::Vector2d pixel(200.0, 700.0);
  const auto reading = reading_towards(model, point, pixel, -1, 1);
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->pan.approach, -1);
  const auto image = predict_pixel(model, *reading, point);
  ASSERT_TRUE(image);
  EXPECT_LT((image->pixel - pixel).norm(), 0.01);
}

}  // namespace
}  // namespace ols::calibration
