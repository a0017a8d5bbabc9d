#include "calibration/pictures/ruler_reading.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/target_scene.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;
using test::Conditions;
using Refusal = RulerReading::Refusal;

constexpr double kBar_m = 0.05, kNear_m = 20.0, kFar_m = 40.0, kMiddle_px = 239.5;

double bar_px(double away_m) { return kBar_m * test::half_size_camera().fx_px / away_m; }

// The near ruler to the left, the far one to the right of it, their zeros so high.
cv::Mat picture(double zero_m, const Conditions& conditions = {}, double roll_rad = 0.0) {
  const auto bars = test::ruler_on(kBar_m, 0.2, 16);
  return test::picture_of(test::half_size_camera(), test::looking_north(roll_rad),
                          {{.middle = {-0.3, kNear_m, zero_m}, .gray = bars},
                           {.middle = {0.6, kFar_m, zero_m}, .gray = bars}},
                          conditions);
}

TEST(Ruler, BothAreFoundByTheHeightOfTheirBarsAndRead) {
  double squares = 0.0;
  int count = 0;
  for (const double zero_m : {-0.21, 0.0, 0.118}) {
    for (const double blur_px : {0.6, 2.5, 4.0}) {
      Conditions conditions{.blur_px = blur_px, .noise_gray = 4.0, .uneven = 0.5};
      conditions.seed = static_cast<unsigned>(count);
      const cv::Mat gray = picture(zero_m, conditions);
      for (const double away_m : {kNear_m, kFar_m}) {
        const auto place = find_ruler(gray, bar_px(away_m));
        ASSERT_TRUE(place);
        const RulerReading reading = read_ruler(gray, *place, bar_px(away_m), kMiddle_px);
        ASSERT_TRUE(reading) << to_string(reading.refusal) << ' ' << away_m << ' ' << blur_px;
        const double off_px = (reading.bars * kBar_m + zero_m) / kBar_m * bar_px(away_m);
        squares += off_px * off_px;
        ++count;
        EXPECT_LT(std::abs(off_px), 0.3);
        EXPECT_NEAR(reading.scale, 1.0, 0.01);
        EXPECT_NEAR(reading.x_px, 319.5 + (away_m == kNear_m ? -0.3 : 0.6) / away_m * 6666.7,
                    0.1 / away_m * 6666.7);
      }
    }
  }
  std::printf("rulers: %.3f px RMS\n", std::sqrt(squares / count));
  EXPECT_LT(std::sqrt(squares / count), 0.1);
}

TEST(Ruler, AFewBarsMayBeHiddenAndTheCameraRolled) {
  const cv::Mat gray = picture(0.0, {.hidden = {{180, 300, 90, 30}}}, 0.02);
  const Vector2d near(319.5 - 100.0, 239.5);
  const RulerReading reading = read_ruler(gray, near, bar_px(kNear_m), kMiddle_px);
  ASSERT_TRUE(reading) << to_string(reading.refusal);
  // Rolled clockwise: what stands to the left is seen lower by 2 px.
  EXPECT_NEAR(reading.zero_px, kMiddle_px + 0.02 * 100.0, 0.2);
}

TEST(Ruler, IsRefusedWithWords) {
  const cv::Mat gray = picture(0.0);
  const Vector2d near(219.5, 239.5), far(419.5, 239.5);
  // The two taken for each other.
  const RulerReading exchanged = read_ruler(gray, far, bar_px(kNear_m), kMiddle_px);
  EXPECT_EQ(exchanged.refusal, Refusal::kScale);
  EXPECT_NEAR(exchanged.scale, 0.5, 0.02);
  EXPECT_EQ(read_ruler(gray, {600.0, 100.0}, bar_px(kNear_m), kMiddle_px).refusal,
            Refusal::kNothing);
  EXPECT_EQ(read_ruler(gray, {700.0, 100.0}, bar_px(kNear_m), kMiddle_px).refusal,
            Refusal::kNothing);
  EXPECT_EQ(
      read_ruler(picture(0.0, {.hidden = {{180, 200, 90, 80}}}), near, bar_px(kNear_m), kMiddle_px)
          .refusal,
      Refusal::kNoZero);
  EXPECT_EQ(
      read_ruler(picture(0.9), {319.5 + 100.0, 60.0}, bar_px(kFar_m), kMiddle_px + 180.0).refusal,
      Refusal::kShort);
  EXPECT_FALSE(find_ruler(cv::Mat(480, 640, CV_8U, cv::Scalar(90)), 16.0));
}

}  // namespace
}  // namespace ols::calibration
