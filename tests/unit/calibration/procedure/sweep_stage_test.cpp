#include "calibration/procedure/sweep_stage.h"

#include <gtest/gtest.h>

#include <map>
#include <opencv2/imgproc.hpp>

#include "calibration/procedure/sweep_plan.h"
#include "tripod.h"

namespace ols::calibration {
namespace {

std::vector<Shot> shots() {
  SweepPlanOptions options;
  options.poses = 12;
  options.field_of_view_rad = {0.096, 0.072};
  return plan_sweep(options);
}

TEST(SweepStage, ItsObservationsAreScenePointsOfTheirPoses) {
  Tripod tripod;
  SweepStage stage(tripod.model().geometry, shots());
  while (const auto order = stage.next()) stage.taken(tripod.shoot(order->shot));
  EXPECT_EQ(stage.progress(), 1.0);
  EXPECT_TRUE(stage.take_remarks().empty());
  std::map<std::string, int> sightings;
  for (const Observation& one : stage.observations()) {
    EXPECT_EQ(one.kind, Kind::kScene);
    ASSERT_TRUE(one.pose);
    EXPECT_GE(*one.pose, 1);
    EXPECT_LE(*one.pose, 12);
    ++sightings[one.reference];
  }
  EXPECT_GT(sightings.size(), 30U);
  for (const auto& [point, times] : sightings) EXPECT_GE(times, 2) << point;
}

TEST(SweepStage, APictureThatIsMissingIsNamedAndTheRestGoesOn) {
  Tripod tripod;
  SweepStage stage(tripod.model().geometry, shots());
  stage.not_taken("the unit did not arrive");
  while (const auto order = stage.next()) stage.taken(tripod.shoot(order->shot));
  const auto remarks = stage.take_remarks();
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_NE(remarks[0].find("picture 1 is missing: the unit did not arrive"), std::string::npos);
  EXPECT_GT(stage.observations().size(), 60U);
}

TEST(SweepStage, FogIsNamed) {
  Tripod tripod;
  SweepStage stage(tripod.model().geometry, shots());
  while (const auto order = stage.next()) {
    Taken picture = tripod.shoot(order->shot);
    picture.gray.setTo(160);
    stage.taken(picture);
  }
  EXPECT_TRUE(stage.observations().empty());
  EXPECT_NE(stage.take_remarks().at(0).find("nothing in the pictures"), std::string::npos);
}

// Trees in the wind: every part of a picture is elsewhere than in the others.
TEST(SweepStage, ASceneThatMovesIsNamed) {
  constexpr int kPart_px = 96, kSway_px = 3;
  Tripod tripod;
  SweepStage stage(tripod.model().geometry, shots());
  cv::RNG wind(3);
  while (const auto order = stage.next()) {
    Taken picture = tripod.shoot(order->shot);
    cv::Mat still;
    cv::copyMakeBorder(picture.gray, still, kSway_px, kSway_px, kSway_px, kSway_px,
                       cv::BORDER_REFLECT);
    for (int y = 0; y + kPart_px <= picture.gray.rows; y += kPart_px) {
      for (int x = 0; x + kPart_px <= picture.gray.cols; x += kPart_px) {
        const cv::Rect from(x + wind.uniform(0, 2 * kSway_px), y + wind.uniform(0, 2 * kSway_px),
                            kPart_px, kPart_px);
        still(from).copyTo(picture.gray({x, y, kPart_px, kPart_px}));
      }
    }
    stage.taken(picture);
  }
  const auto remarks = stage.take_remarks();
  ASSERT_FALSE(remarks.empty());
  EXPECT_NE(remarks[0].find("the scene moves"), std::string::npos) << remarks[0];
}

}  // namespace
}  // namespace ols::calibration
