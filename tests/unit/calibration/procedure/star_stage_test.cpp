#include "calibration/procedure/star_stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "geometry/angles.h"

namespace ols::calibration {
namespace {

Taken night(std::int64_t pose, int stars) {
  Taken taken;
  cv::Mat sky(240, 320, CV_32F, cv::Scalar(10.0)), noise(240, 320, CV_32F);
  for (int i = 0; i < stars; ++i) sky.at<float>(40 + 20 * i, 60 + 25 * i) += 900.0F;
  cv::GaussianBlur(sky, sky, {}, 1.0);
  cv::RNG generator(static_cast<std::uint64_t>(pose) + 1);
  generator.fill(noise, cv::RNG::NORMAL, 0.0, 1.5);
  sky += noise;
  sky.convertTo(taken.gray, CV_8U);
  taken.pose = pose;
  taken.utime_us = 1'780'000'000'000'000;
  return taken;
}

TEST(StarStage, StarsOfEachPictureAreObservationsWithoutNames) {
  StarStage stage(plan_stars({.pictures = 4}));
  std::int64_t pose = 0;
  while (const auto order = stage.next()) {
    EXPECT_GE(order->shot.angles.tilt_rad, 0.21);
    stage.taken(night(++pose, 5));
  }
  const auto all = stage.observations();
  ASSERT_EQ(all.size(), 20U);
  EXPECT_EQ(all[0].kind, Kind::kStar);
  EXPECT_EQ(all[0].reference, "");
  EXPECT_EQ(*all[19].pose, 4);
  EXPECT_TRUE(stage.take_remarks().empty());
}

TEST(StarStage, CloudsAreNamed) {
  StarStage stage(plan_stars({.pictures = 3}));
  std::int64_t pose = 0;
  while (stage.next()) {
    ++pose;
    stage.taken(night(pose, pose == 1 ? 4 : 0));
  }
  EXPECT_NE(stage.take_remarks().at(0).find("2 of 3 pictures show none"), std::string::npos);
}

// Whatever the number of pictures and the span: in even steps of three turns of the worm all
// pictures would be in one phase.
TEST(StarStage, ThePlanSeesAllPhasesOfTheWorms) {
  constexpr double kTurn_rad = 2.0 * kPi / 70.0;
  const auto share_of_turn = [](double angle_rad) {
    return angle_rad / kTurn_rad - std::floor(angle_rad / kTurn_rad);
  };
  for (const int pictures : {16, 19, 20, 24}) {
    for (const double reach_rad : {2.4, 2.6, 2.74}) {
      const auto shots =
          plan_stars({.pictures = pictures, .pan_min_rad = -reach_rad, .pan_max_rad = reach_rad});
      std::array<int, 4> pans{}, low{}, high{};
      for (const Shot& one : shots) {
        EXPECT_LE(std::abs(one.angles.pan_rad), reach_rad);
        ++pans.at(static_cast<std::size_t>(4.0 * share_of_turn(one.angles.pan_rad)));
        auto& band = one.angles.tilt_rad < 0.35 ? low : high;
        ++band.at(static_cast<std::size_t>(4.0 * share_of_turn(one.angles.tilt_rad)));
      }
      for (const auto& quarters : {pans, low, high}) {
        EXPECT_GE(*std::ranges::min_element(quarters), 1) << pictures << " over " << reach_rad;
      }
    }
  }
}

TEST(StarStage, ThePlanIsUnevenFromBothSidesAndAboveTheHaze) {
  const auto shots = plan_stars({});
  int forwards = 0;
  for (std::size_t i = 1; i < shots.size(); ++i) {
    EXPECT_GT(shots[i].angles.pan_rad, shots[i - 1].angles.pan_rad);
    forwards += shots[i].approach_pan == 1 ? 1 : 0;
  }
  EXPECT_NEAR(forwards, 12, 1);
  EXPECT_THROW(plan_stars({.highest_rad = 0.1}), std::invalid_argument);
}

}  // namespace
}  // namespace ols::calibration
