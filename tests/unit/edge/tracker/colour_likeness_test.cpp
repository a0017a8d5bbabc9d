#include "edge/tracker/colour_likeness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace ols::tracker {
namespace {

const Eigen::Vector2d kMiddle(199.5, 149.5), kSize(40.0, 40.0);
const cv::Scalar kRed(30, 30, 200), kGreen(30, 200, 30), kEarth(70, 100, 120), kGrey(90, 90, 90);

// A square at `at` in noise around `ground`.
TrackerInput scene(const cv::Scalar& ground, const cv::Scalar& square, const Eigen::Vector2d& at) {
  TrackerInput frame;
  frame.gray = cv::Mat(300, 400, CV_8U, cv::Scalar(100));
  cv::Mat noise(300, 400, CV_8UC3);
  cv::RNG random(1);
  random.fill(noise, cv::RNG::UNIFORM, 0, 40);
  frame.colour.image = cv::Mat(300, 400, CV_8UC3, ground);
  const cv::Rect box = cv::Rect(static_cast<int>(at.x() - 19.5), static_cast<int>(at.y() - 19.5),
                                static_cast<int>(kSize.x()), static_cast<int>(kSize.y()));
  cv::rectangle(frame.colour.image, box, square, cv::FILLED);
  frame.colour.image += noise;
  return frame;
}

WindowView view_of(const TrackerInput& frame) {
  return view_window(frame, window_around(kMiddle, kSize));
}

WindowView red_on_earth(const Eigen::Vector2d& at = kMiddle) {
  return view_of(scene(kEarth, kRed, at));
}

TEST(ColourLikeness, IsGreatestWhereTheColoursHaveMovedTo) {
  const ColourLikeness red(Palette::kColour, red_on_earth(), kSize);
  const Eigen::Vector2d moved = kMiddle + Eigen::Vector2d(30.0, -20.0);
  const Response response = red.respond(red_on_earth(moved), kSize);
  EXPECT_LT((response.peak().pixel - moved).norm(), 1.5);
  EXPECT_NEAR(response.at(moved), 1.0, 0.1);
  EXPECT_NEAR(response.at(kMiddle + Eigen::Vector2d(-50.0, 50.0)), 0.0, 0.2);
}

TEST(ColourLikeness, AnObjectOfTheSameShapeInAnotherColourIsNotAlike) {
  const ColourLikeness red(Palette::kColour, red_on_earth(), kSize);
  EXPECT_LT(red.respond(view_of(scene(kEarth, kGreen, kMiddle)), kSize).at(kMiddle), 0.2);
}

TEST(ColourLikeness, SeparatesATargetWithAColourOfItsOwnAndNoOther) {
  EXPECT_GT(ColourLikeness(Palette::kColour, red_on_earth(), kSize).separability(), 0.7);
  ColourLikeness same(Palette::kColour, view_of(scene(kGrey, kGrey, kMiddle)), kSize);
  for (int k = 0; k < 20; ++k) {  // what it saw in one image only is noise
    TrackerInput next = scene(kGrey, kGrey, kMiddle);
    cv::flip(next.colour.image, next.colour.image, k % 2);
    same.learn(view_of(next), kSize, 0.1);
  }
  EXPECT_LT(same.separability(), 0.3);
}

TEST(ColourLikeness, LearnsTheColoursThatTheTargetTakesOn) {
  ColourLikeness likeness(Palette::kColour, red_on_earth(), kSize);
  const WindowView green = view_of(scene(kEarth, kGreen, kMiddle));
  const double before = likeness.respond(green, kSize).at(kMiddle);
  for (int k = 0; k < 30; ++k) likeness.learn(green, kSize, 0.1);
  EXPECT_GT(likeness.respond(green, kSize).at(kMiddle), before + 0.5);
}

TEST(ColourLikeness, WithoutAColourImageNothingIsKnown) {
  TrackerInput grey = scene(kEarth, kRed, kMiddle);
  const ColourLikeness red(Palette::kColour, view_of(grey), kSize);
  grey.colour = {};
  ColourLikeness likeness(Palette::kColour, view_of(grey), kSize);
  likeness.learn(red_on_earth(), kSize, 0.5);
  EXPECT_EQ(likeness.separability(), 0.0);
  EXPECT_EQ(likeness.respond(red_on_earth(), kSize).at(kMiddle), 0.0);
  EXPECT_EQ(red.respond(view_of(grey), kSize).at(kMiddle), 0.0);
}

TEST(ColourLikeness, ByHueAnotherExposureChangesNothing) {
  TrackerInput darker = scene(kEarth, kRed, kMiddle);
  darker.colour.image *= 0.6;
  const auto there = [&](Palette palette) {
    const ColourLikeness red(palette, red_on_earth(), kSize);
    return red.respond(view_of(darker), kSize).at(kMiddle);
  };
  EXPECT_GT(there(Palette::kHue), 0.7);
  EXPECT_LT(there(Palette::kColour), 0.5) << "and this is why";
}

TEST(ColourLikeness, ByHueAGreyTargetHasNoColoursOfItsOwn) {
  const TrackerInput bright = scene(kGrey, cv::Scalar(200, 200, 200), kMiddle);
  EXPECT_GT(ColourLikeness(Palette::kColour, view_of(bright), kSize).separability(), 0.7);
  TrackerInput grey = bright;
  cv::cvtColor(bright.colour.image, grey.colour.image, cv::COLOR_BGR2GRAY);
  cv::cvtColor(grey.colour.image, grey.colour.image, cv::COLOR_GRAY2BGR);
  EXPECT_LT(ColourLikeness(Palette::kHue, view_of(grey), kSize).separability(), 0.2);
}

// The box may reach far outside the image.
TEST(ColourLikeness, OfABoxAtTheImagesEdgeIsFinite) {
  const TrackerInput frame = scene(kEarth, kRed, kMiddle);
  const WindowView view = view_window(frame, window_around({0.0, 299.0}, {300.0, 4.0}));
  const ColourLikeness likeness(Palette::kColour, view, {300.0, 4.0});
  for (const float value : likeness.respond(view, {300.0, 4.0}).values) {
    EXPECT_TRUE(std::isfinite(value));
  }
}

}  // namespace
}  // namespace ols::tracker
