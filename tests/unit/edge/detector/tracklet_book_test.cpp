#include "edge/detector/tracklet_book.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <opencv2/core.hpp>
#include <random>
#include <set>
#include <vector>

#include "edge/detector/detection.h"
#include "edge/detector/tracklet.h"

namespace ols::detector {
namespace {

constexpr double kTick_s = 1.0 / 30.0;
const cv::Size kView(640, 480);
const Eigen::Matrix3d kStill = Eigen::Matrix3d::Identity();

Detection clear_spot(double x, double y) {
  return {{x, y}, {3.0, 3.0}, 10.0, true, Evidence::kSpot, true};
}

long confirmed(const TrackletBook& book) {
  long count = 0;
  for (const Tracklet& tracklet : book.tracklets()) count += tracklet.confirmed() ? 1 : 0;
  return count;
}

// A quarter of an hour of clear spots that nothing connects.
double false_an_hour(double allowed) {
  constexpr double kHours = 0.25;
  std::mt19937 random(3);
  std::poisson_distribution<int> number(4.0);
  std::uniform_real_distribution<double> x(0.0, kView.width), y(0.0, kView.height);
  TrackletConfig config;
  config.false_an_hour = allowed;
  TrackletBook book(config, kView);
  std::set<long> ids;
  for (int image = 0; image < kHours * 3600.0 / kTick_s; ++image) {
    std::vector<Detection> detections;
    for (int i = number(random); i > 0; --i) detections.push_back(clear_spot(x(random), y(random)));
    book.advance(detections, kStill, kTick_s);
    for (const Tracklet& tracklet : book.tracklets()) {
      if (tracklet.confirmed()) ids.insert(tracklet.id());
    }
  }
  return static_cast<double>(ids.size()) / kHours;
}

TEST(TrackletBook, ConfirmsClutterAtMostAtTheRateThatIsSet) {
  EXPECT_LE(false_an_hour(40.0), 40.0);
}

TEST(TrackletBook, ConfirmsWhatStaysThenLosesIt) {
  TrackletBook book(TrackletConfig{}, kView);
  int image = 0;
  while (confirmed(book) == 0 && image < 30) {
    book.advance({clear_spot(100.0 + 2 * image, 200.0)}, kStill, kTick_s);
    ++image;
  }
  EXPECT_GT(image, 5) << "one image proves nothing";
  EXPECT_LT(image, 20);
  for (int missed = 0; missed < 10; ++missed) book.advance({}, kStill, kTick_s);
  EXPECT_EQ(confirmed(book), 1) << "a third of a second is bridged";
  for (int missed = 0; missed < 10; ++missed) book.advance({}, kStill, kTick_s);
  EXPECT_TRUE(book.tracklets().empty());
}

TEST(TrackletBook, AfterAPauseWhatIsThereMayBeAnyOtherObject) {
  TrackletBook book(TrackletConfig{}, kView);
  for (int image = 0; image < 30; ++image) {
    book.advance({clear_spot(100.0, 200.0)}, kStill, kTick_s);
  }
  ASSERT_EQ(confirmed(book), 1);
  book.advance({clear_spot(100.0, 200.0)}, kStill, 1.2);
  EXPECT_EQ(confirmed(book), 0);
}

TEST(TrackletBook, AConfirmedObjectKeepsTheOnlyDetectionThoughAnotherIsNearer) {
  TrackletBook book(TrackletConfig{}, kView);
  for (int image = 0; image < 30; ++image) {
    book.advance({clear_spot(100.0, 200.0)}, kStill, kTick_s);
  }
  ASSERT_EQ(confirmed(book), 1);
  book.advance({clear_spot(100.0, 200.0), clear_spot(103.0, 200.0)}, kStill, kTick_s);
  book.advance({clear_spot(101.7, 200.0)}, kStill, kTick_s);
  for (const Tracklet& tracklet : book.tracklets()) {
    EXPECT_EQ(tracklet.seen(), tracklet.confirmed()) << tracklet.pixel().x();
  }
}

TEST(TrackletBook, KeepsTheIdentityOfWhatItCannotSeeForAMoment) {
  TrackletBook book(TrackletConfig{}, kView);
  for (int image = 0; image < 60; ++image) {
    const bool hidden = image >= 40 && image < 47;
    std::vector<Detection> detections;
    if (!hidden) detections.push_back(clear_spot(100.0 + 2 * image, 200.0));
    book.advance(detections, kStill, kTick_s);
  }
  ASSERT_EQ(book.tracklets().size(), 1U);
  EXPECT_EQ(book.tracklets()[0].id(), 1);
}

TEST(TrackletBook, ShakenCameraDoesNotEndAnObjectBeforeTheSky) {
  TrackletBook book(TrackletConfig{}, kView);
  double x = 300.0;
  for (int image = 0; image < 90; ++image) {
    if (image > 30 && image % 10 == 0) x += image % 20 == 0 ? 25.0 : -25.0;
    book.advance({clear_spot(x, 200.0)}, kStill, kTick_s);
  }
  ASSERT_EQ(book.tracklets().size(), 1U);
  EXPECT_EQ(book.tracklets()[0].id(), 1);
}

TEST(TrackletBook, BeforeTheGroundOnlyWhatTravelsIsConfirmed) {
  for (const double step_px : {0.0, 2.0}) {
    TrackletBook book(TrackletConfig{}, kView);
    for (int image = 0; image < 60; ++image) {
      Detection detection = clear_spot(100.0 + step_px * image, 200.0);
      detection.clear = false;
      book.advance({detection}, kStill, kTick_s);
    }
    EXPECT_EQ(confirmed(book), step_px > 0.0 ? 1 : 0) << step_px;
  }
}

// A clear spot in ten seconds of a night in which stars move by 0.1 px an image. `scene_px`: what
// the images show of the scene's motion; without a scene, they show that of the stars.
long confirmed_at_night(double step_px, double scene_px) {
  Eigen::Matrix3d motion = kStill, star_motion = kStill;
  motion(0, 2) = scene_px;
  star_motion(0, 2) = 0.1;
  TrackletBook book(TrackletConfig{}, kView);
  for (int image = 0; image < 100; ++image)
    book.advance({clear_spot(100.0 + step_px * image, 200.0)}, motion, 0.1, {true, star_motion});
  return confirmed(book);
}

TEST(TrackletBook, AStarIsNoObjectAndWhatHoversBesideItIsOne) {
  for (const double scene_px : {0.0, 0.1}) {
    EXPECT_EQ(confirmed_at_night(0.1, scene_px), 0);
    EXPECT_EQ(confirmed_at_night(2.0, scene_px), 1);
  }
  EXPECT_EQ(confirmed_at_night(0.0, 0.0), 1);
}

// The heading is wrong, so the path of the star is a tenth too short.
TEST(TrackletBook, AStarIsNoObjectHoweverLongItsPath) {
  Eigen::Matrix3d told = kStill;
  told(0, 2) = 0.45;
  TrackletBook book(TrackletConfig{}, kView);
  for (int image = 0; image < 600; ++image)
    book.advance({clear_spot(100.0 + 0.5 * image, 200.0)}, kStill, 0.1, {true, told});
  EXPECT_EQ(confirmed(book), 0);
}

TEST(TrackletBook, AnImageWithoutTheMountsAnglesConfirmsNoStar) {
  Eigen::Matrix3d star_motion = kStill;
  star_motion(0, 2) = 0.1;
  TrackletBook book(TrackletConfig{}, kView);
  for (int image = 0; image < 100; ++image) {
    const bool known = image % 20 != 19;
    const Stars stars{true, known ? std::optional(star_motion) : std::nullopt};
    book.advance({clear_spot(100.0 + 0.1 * image, 200.0)}, kStill, 0.1, stars);
  }
  EXPECT_EQ(confirmed(book), 0);
}

// A clear spot that began with a turning camera and moves `own_px` an image relative to the scene,
// which moves `scene_px`.
long confirmed_in_turn(double scene_px, double own_px) {
  Eigen::Matrix3d motion = kStill;
  motion(0, 2) = scene_px;
  TrackletBook book(TrackletConfig{}, kView);
  for (int image = 0; image < 60; ++image) {
    book.advance({clear_spot(300.0 + (scene_px + own_px) * image, 200.0)}, motion, kTick_s);
  }
  return confirmed(book);
}

TEST(TrackletBook, WhileTheCameraTurnsPartsOfSceneAndCameraAreNoObjects) {
  EXPECT_EQ(confirmed_in_turn(3.0, 0.0), 0) << "moves along with the scene";
  EXPECT_EQ(confirmed_in_turn(3.0, -3.0), 0) << "stays in the image";
  EXPECT_EQ(confirmed_in_turn(3.0, -2.8), 1) << "nearly held in the image by the camera";
  EXPECT_EQ(confirmed_in_turn(3.0, 1.5), 1);
  EXPECT_EQ(confirmed_in_turn(0.0, 0.0), 1) << "hovers, and the camera rests";
}

// A spot against the ground that moves `own_px` an image relative to the scene, while the scene
// moves `scene_px` an image to and fro in the image. In the first images this motion is unknown.
long confirmed_in_sway(double scene_px, double own_px, int unknown_images = 0) {
  TrackletBook book(TrackletConfig{}, kView);
  double x = 300.0;
  for (int image = 0; image < 90; ++image) {
    Eigen::Matrix3d motion = kStill;
    motion(0, 2) = image / 15 % 2 == 0 ? scene_px : -scene_px;
    x += motion(0, 2) + own_px;
    Detection detection = clear_spot(x, 200.0);
    detection.clear = false;
    const bool known = image >= unknown_images;
    book.advance({detection}, known ? std::optional(motion) : std::nullopt, kTick_s);
  }
  return confirmed(book);
}

TEST(TrackletBook, WhileTheCameraMovesWhatCreepsBeforeTheGroundIsNoObject) {
  EXPECT_EQ(confirmed_in_sway(0.5, 0.3), 0) << "creeps";
  EXPECT_EQ(confirmed_in_sway(0.0, 0.3), 1) << "the camera rests";
  EXPECT_EQ(confirmed_in_sway(0.5, 1.0), 1) << "travels";
  EXPECT_EQ(confirmed_in_sway(1.0, 1.0, 60), 1) << "travels; the time before does not count";
  EXPECT_EQ(confirmed_in_sway(0.1, 0.15), 1) << "the camera rests, but for the error of its motion";
}

TEST(TrackletBook, WhatFlewIsNotDoubtedWhenItHoversBeforeTheGround) {
  TrackletBook book(TrackletConfig{}, kView);
  for (int image = 0; image < 240; ++image) {
    Detection detection = clear_spot(100.0 + std::min(image, 60), 200.0);
    detection.clear = image < 60;
    book.advance({detection}, kStill, kTick_s);
  }
  EXPECT_EQ(confirmed(book), 1);
}

// Where the book has the object that moves along 100 + 2 * image, after 60 images. From image 40
// on, its detections are 2 px below it and twice as wide, and its appearance shows where it is.
Tracklet beside_another(bool clear) {
  TrackletBook book(TrackletConfig{}, kView);
  for (int image = 0; image < 60; ++image) {
    const Eigen::Vector2d is(100.0 + 2.0 * image, 200.0);
    Detection detection = clear_spot(is.x(), is.y());
    detection.clear = clear;
    detection.size_px = {10.0, 10.0};
    if (image >= 40) {
      detection.pixel.y() += 2.0;
      detection.size_px.x() *= 2.0;
    }
    book.advance({detection}, kStill, kTick_s, {}, [&](const Tracklet&) { return is; });
  }
  EXPECT_EQ(confirmed(book), 1);
  return book.tracklets().front();
}

TEST(TrackletBook, AppearanceGivesThePlaceBeforeTheGroundAndDetectionsBeforeTheSky) {
  const Tracklet before_ground = beside_another(false), before_sky = beside_another(true);
  EXPECT_NEAR(before_ground.pixel().y(), 200.0, 0.5);
  EXPECT_NEAR(before_ground.size_px().x(), 10.0, 0.5) << "of the detections that show it alone";
  EXPECT_NEAR(before_sky.pixel().y(), 202.0, 0.5);
}

TEST(TrackletBook, OnlyWhatIsConfirmedIsRecognised) {
  TrackletBook book(TrackletConfig{}, kView);
  bool asked = false;
  const Recognise recognise = [&](const Tracklet& tracklet) {
    EXPECT_TRUE(tracklet.confirmed());
    asked = true;
    return tracklet.pixel();
  };
  for (int image = 0; image < 60; ++image) {
    std::vector<Detection> detections;
    if (image < 40) detections.push_back(clear_spot(100.0 + 2.0 * image, 200.0));
    for (Detection& detection : detections) detection.clear = false;
    book.advance(detections, kStill, kTick_s, {}, recognise);
  }
  EXPECT_TRUE(asked);
  EXPECT_EQ(confirmed(book), 1) << "recognised for longer than it is kept without";
}

// Five spots in each image, somewhere in the first tile: waves of a dark sea.
class Waves {
 public:
  std::vector<Detection> with(std::vector<Detection> detections) {
    for (int i = 0; i < 5; ++i) detections.push_back(clear_spot(x_(random_), y_(random_)));
    return detections;
  }

 private:
  std::mt19937 random_{5};
  std::uniform_real_distribution<double> x_{0.0, 80.0}, y_{0.0, 80.0};
};

TEST(TrackletBook, AmongWavesOnlyWhatTravelsIsConfirmed) {
  for (const double step_px : {0.0, 0.3}) {
    Waves waves;
    TrackletBook book(TrackletConfig{}, kView);
    for (int image = 0; image < 300; ++image) book.advance(waves.with({}), kStill, kTick_s);
    long most = 0;
    for (int image = 0; image < 150; ++image) {
      book.advance(waves.with({clear_spot(20.0 + step_px * image, 40.0)}), kStill, kTick_s);
      most = std::max(most, confirmed(book));
    }
    EXPECT_EQ(most, step_px > 0.0 ? 1 : 0) << step_px;
  }
}

TEST(TrackletBook, CrowdedTileNeedsMoreThanAnEmptyOne) {
  Waves waves;
  TrackletBook book(TrackletConfig{}, kView);
  for (int image = 0; image < 300; ++image) book.advance(waves.with({}), kStill, kTick_s);
  int quiet = 0;
  while (confirmed(book) == 0 && quiet < 60) {
    book.advance(waves.with({clear_spot(400.0, 300.0)}), kStill, kTick_s);
    ++quiet;
  }
  EXPECT_LT(quiet, 20) << "the clutter of one corner makes the rest blind";
  int crowded = 0;
  while (confirmed(book) == 1 && crowded < 120) {
    const Detection travels = clear_spot(20.0 + crowded, 40.0);
    book.advance(waves.with({clear_spot(400.0, 300.0), travels}), kStill, kTick_s);
    ++crowded;
  }
  EXPECT_GT(crowded, quiet);
  EXPECT_LT(crowded, 120);
}

constexpr int kStack = 8;  // images

// Of a point that moves by a pixel per image, in a stack's last image.
Detection dim_point(int image, long path) {
  Detection point;
  point.pixel = {100.0 + image, 200.0};
  point.size_px = {4.0, 4.0};
  point.brighter = true;
  point.evidence = Evidence::kStack;
  point.path = Path{path, {1.0 / kTick_s, 0.0}};
  return point;
}

// As many images, in which the first stacks show a point.
void show(TrackletBook& book, int stacks, int images) {
  for (int image = 0; image < images; ++image) {
    const bool shown = image % kStack == 0 && image / kStack < stacks;
    book.advance(shown ? std::vector{dim_point(image, 1)} : std::vector<Detection>{}, kStill,
                 kTick_s);
  }
}

TEST(TrackletBook, ConfirmsADimPointByAFewStacks) {
  TrackletBook once(TrackletConfig{}, kView);
  show(once, 2, kStack + 1);
  EXPECT_EQ(confirmed(once), 0) << "two stacks may be noise";
  TrackletBook book(TrackletConfig{}, kView);
  show(book, 4, 3 * kStack + 1);
  ASSERT_EQ(confirmed(book), 1);
  ASSERT_EQ(book.tracklets().size(), 1U);
  EXPECT_NEAR(book.tracklets()[0].pixel().x(), 100.0 + 3 * kStack, 1.0);
}

TEST(TrackletBook, DimPointGoesOnBetweenStacksAndEndsAfterTwo) {
  TrackletBook book(TrackletConfig{}, kView);
  show(book, 5, 5 * kStack + 5);
  ASSERT_EQ(confirmed(book), 1);
  EXPECT_FALSE(book.tracklets()[0].seen()) << "no measurement in this image";
  EXPECT_NEAR(book.tracklets()[0].pixel().x(), 100.0 + 5 * kStack + 4, 3.0);
  for (int image = 0; image < 2 * kStack; ++image) book.advance({}, kStill, kTick_s);
  EXPECT_TRUE(book.tracklets().empty());
}

TEST(TrackletBook, SpotsAroundADimPointAreNotIt) {
  TrackletBook book(TrackletConfig{}, kView);
  show(book, 5, 4 * kStack + 1);
  for (int image = 1; image < kStack; ++image)
    book.advance({clear_spot(100.0 + 4 * kStack + image, 230.0)}, kStill, kTick_s);
  ASSERT_FALSE(book.tracklets().empty());
  EXPECT_NEAR(book.tracklets()[0].pixel().y(), 200.0, 1.0);
}

TEST(TrackletBook, ADimPointDoesNotContinueASpotThatIsNotNearIt) {
  TrackletBook book(TrackletConfig{}, kView);
  book.advance({clear_spot(112.0, 205.0)}, kStill, kTick_s);
  book.advance({dim_point(1, 1)}, kStill, kTick_s);
  EXPECT_EQ(book.tracklets().size(), 2U) << "of a single image nearly any motion would fit";
}

TEST(TrackletBook, DimPointsDoNotCountAsClutterOfSpots) {
  const auto images_until_confirmed = [](bool dim_points) {
    TrackletBook book(TrackletConfig{}, kView);
    const auto is_confirmed = [&] {
      return std::ranges::any_of(book.tracklets(), [](const Tracklet& tracklet) {
        return tracklet.confirmed() && !tracklet.path();
      });
    };
    int image = 0;
    for (; !is_confirmed() && image < 200; ++image) {
      std::vector<Detection> detections{clear_spot(110.0, 210.0)};
      for (long i = 0; dim_points && i < 4; ++i) {
        detections.push_back(dim_point(0, 10 * image + i));
        detections.back().pixel = {85.0 + 13.0 * static_cast<double>(i), 235.0};
      }
      if (image < 20) detections.erase(detections.begin());
      book.advance(detections, kStill, kTick_s);
    }
    return image;
  };
  EXPECT_EQ(images_until_confirmed(true), images_until_confirmed(false));
}

TEST(TrackletBook, SpotAtADimPointContinuesIt) {
  TrackletBook book(TrackletConfig{}, kView);
  show(book, 4, 3 * kStack + 1);
  book.advance({clear_spot(101.0 + 3 * kStack, 200.5)}, kStill, kTick_s);
  ASSERT_EQ(book.tracklets().size(), 1U);
  EXPECT_TRUE(book.tracklets()[0].seen());
}

}  // namespace
}  // namespace ols::detector
