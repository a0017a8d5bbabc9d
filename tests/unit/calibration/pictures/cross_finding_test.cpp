#include "calibration/pictures/cross_finding.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/target_scene.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::Board;
using test::Conditions;
using Refusal = Crosses::Refusal;

constexpr double kAway_m = 30.0, kApart_m = 0.8, kArm_m = 0.12, kThick_m = 0.03;

// Of the board at its stated distance.
CrossSize size_at(double away_m, double apart_m = kApart_m) {
  const double px_m = test::half_size_camera().fx_px / away_m;
  return {kArm_m * px_m, kThick_m * px_m, apart_m * px_m};
}

struct View {
  cv::Mat gray;
  Vector2d right_px;
};
View view(double roll_rad, double east_m, const Conditions& conditions = {},
          double away_m = kAway_m) {
  const CameraIntrinsics camera = test::half_size_camera();
  const Eigen::Isometry3d pose = test::looking_north(roll_rad);
  const Vector3d place(east_m, away_m, -0.13);
  const Board board{.middle = place, .gray = test::crosses_on(kApart_m, kArm_m, kThick_m)};
  return {test::picture_of(camera, pose, {board}, conditions),
          project(camera, pose.linear().transpose() * place).value()};
}

TEST(Crosses, AreFoundAndPlacedToAFractionOfAPixel) {
  double squares = 0.0;
  int count = 0;
  for (const double blur_px : {0.6, 2.0, 4.0}) {
    for (const double roll_rad : {-0.03, 0.0, 0.02}) {
      Conditions conditions{.blur_px = blur_px, .noise_gray = 4.0, .uneven = 0.5};
      conditions.seed = static_cast<unsigned>(++count);
      const View seen = view(roll_rad, 0.3 + 0.01 * count, conditions);
      const Crosses found = find_crosses(seen.gray, size_at(kAway_m));
      ASSERT_TRUE(found) << to_string(found.refusal);
      squares += (found.right_px - seen.right_px).squaredNorm();
      EXPECT_NEAR(found.scale, 1.0, 0.02);
      EXPECT_LT(found.left_px.x(), found.right_px.x());
    }
  }
  const double rms = std::sqrt(0.5 * squares / count);
  std::printf("crosses: %.3f px RMS\n", rms);
  EXPECT_LT(rms, 0.1);
}

TEST(Crosses, OneAloneIsEnoughWhereTheCameraStandsAboveTheAxis) {
  const CameraIntrinsics camera = test::half_size_camera();
  const Board board{.middle = {0.2, kAway_m, 0.1}, .gray = test::crosses_on(0.0, kArm_m, kThick_m)};
  const cv::Mat gray = test::picture_of(camera, test::looking_north(), {board});
  const Crosses found = find_crosses(gray, size_at(kAway_m, 0.0));
  ASSERT_TRUE(found) << to_string(found.refusal);
  EXPECT_EQ(found.left_px, found.right_px);
  EXPECT_LT((found.right_px - project(camera, {0.2, -0.1, kAway_m}).value()).norm(), 0.25);
}

// Half of an arm is behind a branch.
TEST(Crosses, APartMayBeHidden) {
  const View clear = view(0.0, 0.3);
  const int x = static_cast<int>(clear.right_px.x()), y = static_cast<int>(clear.right_px.y());
  const View hidden = view(0.0, 0.3, {.hidden = {{x - 4, y - 40, 8, 22}}});
  const Crosses found = find_crosses(hidden.gray, size_at(kAway_m));
  ASSERT_TRUE(found) << to_string(found.refusal);
  EXPECT_LT((found.right_px - hidden.right_px).norm(), 0.5);
}

TEST(Crosses, AreRefusedWithWords) {
  const View seen = view(0.0, 0.3);
  EXPECT_EQ(find_crosses(cv::Mat(480, 640, CV_8U, cv::Scalar(90)), size_at(30.0)).refusal,
            Refusal::kNothing);
  // The distance that was stated is wrong: by how much is told.
  const Crosses wrong = find_crosses(seen.gray, size_at(22.0));
  EXPECT_EQ(wrong.refusal, Refusal::kScale);
  EXPECT_NEAR(22.0 / wrong.scale, kAway_m, 1.0);
  const int x = static_cast<int>(seen.right_px.x()), y = static_cast<int>(seen.right_px.y());
  const View one = view(0.0, 0.3, {.hidden = {{x - 40, y - 40, 80, 80}}});
  EXPECT_EQ(find_crosses(one.gray, size_at(kAway_m)).refusal, Refusal::kOne);
  EXPECT_NE(std::string(to_string(Refusal::kOne)).find("one of the two"), std::string::npos);
}

}  // namespace
}  // namespace ols::calibration
