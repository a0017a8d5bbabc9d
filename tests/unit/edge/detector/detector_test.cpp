#include "edge/detector/detector.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "edge/detector/detector_work.h"
#include "edge/detector/tracklet.h"

namespace ols::detector {
namespace {

constexpr double kInterval_s = 1.0 / 30.0;
constexpr double kNoise = 2.0;  // [grey levels]
constexpr int kImages = 45;     // a second and a half
const cv::Size kSize(320, 240);

// The scene of an image, by its number: 32-bit floating point, grey levels.
using Scene = std::function<cv::Mat(int)>;

// A detector that has looked at a scene through a noisy camera for `images` images.
class Watch {
 public:
  // `shift`: what the mount says that the camera's turn moves the scene by in an image.
  explicit Watch(const Scene& scene, int images = kImages,
                 const std::optional<Eigen::Vector2d>& shift = Eigen::Vector2d(0.0, 0.0)) {
    std::optional<Eigen::Matrix3d> motion;
    if (shift) {
      motion = Eigen::Matrix3d::Identity();
      motion->topRightCorner<2, 1>() = *shift;
    }
    for (int i = 0; i < images; ++i) {
      cv::Mat picture = scene(i), noise(kSize, CV_32F), gray;
      random_.fill(noise, cv::RNG::NORMAL, 0.0, kNoise);
      cv::add(picture, noise, picture);
      picture.convertTo(gray, CV_8U);
      const auto result = detector_.advance(gray, i * kInterval_s, motion);
      detections_ += result.detections.size();
      for (const Tracklet& tracklet : detector_.tracklets()) {
        if (!tracklet.confirmed()) continue;
        confirmed_.insert(tracklet.id());
        if (first_ < 0) first_ = i;
      }
    }
  }

  std::size_t detections() const { return detections_; }
  std::size_t confirmed() const { return confirmed_.size(); }  // ever
  int first() const { return first_; }                         // image with a confirmed one; -1
  long suspended() const { return detector_.suspended_images(); }
  // The confirmed tracklet that is left at the end, if it is the only one.
  std::optional<Tracklet> only() const {
    std::vector<Tracklet> left;
    for (const Tracklet& tracklet : detector_.tracklets()) {
      if (tracklet.confirmed()) left.push_back(tracklet);
    }
    if (left.size() != 1) return std::nullopt;
    return left.front();
  }

 private:
  cv::RNG random_{7};
  Detector detector_{DetectorConfig{}, kSize};
  std::size_t detections_ = 0;
  std::set<long> confirmed_;
  int first_ = -1;
};

cv::Mat sky() { return cv::Mat(kSize, CV_32F, cv::Scalar(120.0)); }

void add(cv::Mat& image, const cv::Rect& box, double levels) {
  cv::Mat part = image(box);
  cv::add(part, cv::Scalar(levels), part);
}

// A piece of ground, larger than an image, that begins `from` pixels to the right.
cv::Mat ground(double from) {
  static const cv::Mat all = [] {
    cv::Mat rough(300, 700, CV_32F);
    cv::RNG(11).fill(rough, cv::RNG::NORMAL, 0.0, 1.0);
    cv::GaussianBlur(rough, rough, cv::Size(0, 0), 2.5);
    cv::normalize(rough, rough, 60.0, 200.0, cv::NORM_MINMAX);
    return rough;
  }();
  const cv::Matx23d shift(1, 0, -from, 0, 1, 0);
  cv::Mat image;
  cv::warpAffine(all, image, shift, kSize, cv::INTER_LINEAR);
  return image;
}

void expect_at(const std::optional<Tracklet>& tracklet, double x, double y) {
  ASSERT_TRUE(tracklet);
  EXPECT_NEAR(tracklet->pixel().x(), x, 2.0);
  EXPECT_NEAR(tracklet->pixel().y(), y, 2.0);
}

TEST(Detector, FindsPointsBeforeTheSkyWithinASecond) {
  for (const int side : {2, 3, 6}) {
    // 8 standard deviations in the mean of 3 by 3 pixels around it.
    const double levels = 8.0 * kNoise * std::max(1.0, 9.0 / (side * side));
    for (const double sign : {1.0, -1.0}) {
      const Watch watch([&](int i) {
        cv::Mat image = sky();
        add(image, {60 + i, 100, side, side}, sign * levels);
        return image;
      });
      SCOPED_TRACE(side * sign);
      expect_at(watch.only(), 60 + kImages - 1 + (side - 1) / 2.0, 100 + (side - 1) / 2.0);
      EXPECT_EQ(watch.confirmed(), 1U);
      EXPECT_LT(watch.first(), 20);
    }
  }
}

// Two standard deviations in the mean of its 3 by 3 pixels.
TEST(Detector, FindsADimMoverBeforeTheSkyWithinThreeSeconds) {
  constexpr int kLong = 90;
  const Watch watch(
      [&](int i) {
        cv::Mat image = sky();
        add(image, {40 + 2 * i, 60 + i, 3, 3}, 2.0 * kNoise);
        return image;
      },
      kLong);
  expect_at(watch.only(), 41 + 2 * (kLong - 1), 61 + kLong - 1);
}

TEST(Detector, FindsWhatHovers) {
  const Watch watch([](int) {
    cv::Mat image = sky();
    add(image, {200, 80, 3, 3}, -40.0);
    return image;
  });
  expect_at(watch.only(), 201, 81);
}

TEST(Detector, BrightOneDoesNotHideItsNeighbour) {
  const Watch watch([](int) {
    cv::Mat image = sky();
    add(image, {100, 80, 4, 4}, 130.0);
    add(image, {109, 80, 3, 3}, 25.0);
    return image;
  });
  EXPECT_EQ(watch.confirmed(), 2U);
}

TEST(Detector, NoiseGivesHardlyADetection) {
  const Watch watch([](int) { return sky(); }, 150);
  EXPECT_LT(watch.detections(), 15U);
  EXPECT_EQ(watch.confirmed(), 0U);
}

TEST(Detector, PartsOfAStillSceneAreNoObjects) {
  const Watch watch([](int) { return ground(0.0); });
  EXPECT_EQ(watch.confirmed(), 0U);
}

TEST(Detector, EdgeOfACloudIsNoObject) {
  const Watch watch([](int i) {
    cv::Mat image = sky();
    cv::ellipse(image, cv::Point(150 + i / 4, 240), cv::Size(170, 140), 0, 0, 360,
                cv::Scalar(180.0), cv::FILLED);
    cv::GaussianBlur(image, image, cv::Size(0, 0), 3.0);
    return image;
  });
  EXPECT_EQ(watch.confirmed(), 0U);
}

TEST(Detector, EndOfABranchIsNoObject) {
  const Watch watch([](int) {
    cv::Mat image = sky();
    cv::line(image, {150, 239}, {150, 100}, cv::Scalar(200.0), 3);
    cv::line(image, {60, 239}, {90, 130}, cv::Scalar(60.0), 2);
    return image;
  });
  EXPECT_EQ(watch.confirmed(), 0U);
}

// Nothing but its own corners could tell how the camera moved.
TEST(Detector, OnlyThingBeforeTheSkyDoesNotCarryTheSceneAlong) {
  const Watch watch(
      [](int i) {
        cv::Mat image = sky();
        for (int column = 0; column < 14; ++column) {
          for (int row = 0; row < 7; ++row) {
            const double levels = (column + row) % 2 == 0 ? 60.0 : 120.0;
            add(image, {60 + i + 5 * column, 100 + 5 * row, 5, 5}, levels);
          }
        }
        return image;
      },
      90, std::nullopt);
  const auto only = watch.only();
  ASSERT_TRUE(only);
  EXPECT_NEAR(only->pixel().x(), 60 + 89 + 34.5, 15.0);
  EXPECT_NEAR(only->pixel().y(), 100 + 17.0, 10.0);
}

TEST(Detector, DefectOfTheSensorIsNoObject) {
  const Watch watch([](int) {
    cv::Mat image = sky();
    add(image, {150, 90, 1, 1}, 130.0);
    return image;
  });
  EXPECT_EQ(watch.confirmed(), 0U);
}

TEST(Detector, ChangeOfExposureSuspendsAndConfirmsNothing) {
  const Watch watch([](int i) {
    cv::Mat image = ground(0.0);
    if (i >= 20) image *= 1.25;
    return image;
  });
  EXPECT_GE(watch.suspended(), 1);
  EXPECT_EQ(watch.confirmed(), 0U);
}

TEST(Detector, FindsALargeMoverBeforeTheGround) {
  const Watch watch([](int i) {
    cv::Mat image = ground(0.0);
    cv::rectangle(image, cv::Rect(40 + 3 * i, 120, 40, 24), cv::Scalar(30.0), cv::FILLED);
    return image;
  });
  const auto only = watch.only();
  ASSERT_TRUE(only) << "it, and no ghost where it was";
  EXPECT_NEAR(only->pixel().x(), 40 + 3 * (kImages - 1) + 20, 10.0);
  EXPECT_NEAR(only->pixel().y(), 132, 6.0);
}

// Something like the ground that has moved by 3 px an image, up to image `last`. Only its motion
// shows it: it is no spot.
cv::Mat walker_on_ground(int image, int last) {
  cv::Mat picture = ground(0.0);
  const int x = 40 + 3 * std::min(image, last);
  ground(200.0)(cv::Rect(60, 20, 24, 36)).copyTo(picture(cv::Rect(x, 110, 24, 36)));
  return picture;
}

TEST(Detector, RecognisesWhatStopsBeforeTheGround) {
  constexpr int kStops = 45, kLater = 80;  // after a second, the scene contains it
  const Watch watch([](int i) { return walker_on_ground(i, kStops); }, kStops + kLater);
  const auto only = watch.only();
  ASSERT_TRUE(only);
  EXPECT_TRUE(only->seen());
  EXPECT_NEAR(only->pixel().x(), 40 + 3 * kStops + 12, 12.0) << "on it";
  EXPECT_NEAR(only->pixel().y(), 128, 18.0);
}

TEST(Detector, DoesNotRecogniseInTheGroundWhatIsGone) {
  constexpr int kGone = 45, kLater = 20;
  const auto scene = [](int i) { return i < kGone ? walker_on_ground(i, i) : ground(0.0); };
  EXPECT_EQ(Watch(scene, kGone).only().has_value(), true);
  EXPECT_EQ(Watch(scene, kGone + kLater).only().has_value(), false);
}

TEST(Detector, MovingCameraLeavesTheGroundAloneAndFindsTheMover) {
  constexpr double kTurn_px = 2.3;  // an image
  const Eigen::Vector2d shift(-kTurn_px, 0.0);
  const Watch alone([](int i) { return ground(kTurn_px * i); }, kImages, shift);
  EXPECT_EQ(alone.confirmed(), 0U);
  const Watch watch(
      [](int i) {
        cv::Mat image = ground(kTurn_px * i);
        cv::rectangle(image, cv::Rect(150, 60 + 2 * i, 14, 14), cv::Scalar(250.0), cv::FILLED);
        return image;
      },
      kImages, shift);
  expect_at(watch.only(), 156.5, 66.5 + 2 * (kImages - 1));
}

TEST(PictureDetector, SaysHowThePictureMovedSinceTheLast) {
  PictureDetector detector({});
  const auto look = [&detector](double from_px, double time_s) {
    cv::Mat gray;
    ground(from_px).convertTo(gray, CV_8U);
    return detector.look({gray, time_s, std::nullopt});
  };
  EXPECT_FALSE(look(0.0, 1.0).motion);
  const Found found = look(2.0, 1.1);
  ASSERT_TRUE(found.motion);
  EXPECT_EQ(found.from_s, 1.0);
  const Eigen::Vector2d to =
      (found.motion->homography * found.motion->middle_px.homogeneous()).hnormalized();
  EXPECT_NEAR(to.x() - found.motion->middle_px.x(), -2.0, 4.0 * found.motion->sd_px + 0.02);
  EXPECT_GT(found.motion->sd_px, 0.0);
  EXPECT_LT(found.motion->sd_px, 0.1);
}

TEST(Detector, ImageCorrectsWhatTheMountSaid) {
  constexpr double kTurn_px = 2.0;  // an image; the mount says nothing
  const Watch watch([](int i) { return ground(kTurn_px * i); });
  EXPECT_EQ(watch.confirmed(), 0U);
}

}  // namespace
}  // namespace ols::detector
