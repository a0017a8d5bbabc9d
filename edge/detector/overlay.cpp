#include "edge/detector/overlay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

#include "edge/tracker/ego_motion.h"
#include "edge/tracker/particle.h"

namespace ols::detector {
namespace {

constexpr double kMoved_px = 8.0;               // most structures of a scene are narrower
constexpr double kStill = 0.25;                 // of what the mount says
constexpr double kPredicted_px = 16.0;          // a mount's angles may come in steps of some pixels
constexpr double kStructure = 24.0;             // [grey levels] between a pixel's neighbours
constexpr double kSame = 5.0, kDiffers = 12.0;  // [grey levels]
constexpr int kMost = 6, kEnough = 3;           // scores

// The least shift of the image's centre, corners and middles of the sides. If a text along one side
// makes the camera seem to rest, the motion is measured there, and is uncertain elsewhere.
double shift_px(const Eigen::Matrix3d& motion, const cv::Size& image) {
  double least = std::numeric_limits<double>::infinity();
  for (const double x : {0.0, 0.5, 1.0}) {
    for (const double y : {0.0, 0.5, 1.0}) {
      const Eigen::Vector2d at(x * image.width, y * image.height);
      least = std::min(least, (tracker::transform(motion, at) - at).norm());
    }
  }
  return least;
}

cv::Mat structures(const cv::Mat& image) {
  cv::Mat range;
  cv::morphologyEx(image, range, cv::MORPH_GRADIENT, cv::Mat::ones(3, 3, CV_8U));
  return range >= kStructure;
}

cv::Mat brought(const cv::Mat& earlier, const Eigen::Matrix3d& moved) {
  cv::Mat matrix, image;
  cv::eigen2cv(moved, matrix);
  cv::warpPerspective(earlier, image, matrix, earlier.size(), cv::INTER_LINEAR,
                      cv::BORDER_REPLICATE);
  return image;
}

// [grey levels] By how much the image differs from all that is within a pixel in the other one.
cv::Mat outside(const cv::Mat& image, const cv::Mat& other) {
  const cv::Mat element = cv::Mat::ones(3, 3, CV_8U);
  cv::Mat low, high, darker, brighter;
  cv::erode(other, low, element);
  cv::dilate(other, high, element);
  cv::subtract(image, high, brighter);
  cv::subtract(low, image, darker);
  return cv::max(brighter, darker);
}

}  // namespace

void Overlay::restart(const cv::Mat& image) {
  earlier_ = image;
  moved_.setIdentity();
  predicted_.setIdentity();
}

bool Overlay::advance(const cv::Mat& image, const std::optional<Eigen::Matrix3d>& motion,
                      const std::optional<Eigen::Matrix3d>& predicted) {
  if (earlier_.empty() || !motion) {
    restart(image);
    return false;
  }
  moved_ = *motion * moved_;
  predicted_ = predicted.value_or(*motion) * predicted_;
  if (!tracker::aligns(moved_) || !tracker::aligns(predicted_)) {
    restart(image);
    return false;
  }
  const double by_images_px = shift_px(moved_, image.size());
  const double by_mount_px = shift_px(predicted_, image.size());
  const bool held = by_mount_px >= kPredicted_px && by_images_px < kStill * by_mount_px;
  if (by_images_px < kMoved_px && !held) return false;
  count(image, held ? predicted_ : moved_);
  restart(image);
  return held;
}

// A structure counts if it is where it was, and not where the scene has gone.
void Overlay::count(const cv::Mat& image, const Eigen::Matrix3d& moved) {
  cv::Mat difference;
  cv::absdiff(image, earlier_, difference);
  const cv::Mat stays = difference <= kSame, changes = difference > kDiffers;
  const cv::Mat lies_apart = outside(image, brought(earlier_, moved)) > kDiffers;
  if (score_.empty()) score_ = cv::Mat::zeros(image.size(), CV_8U);
  cv::add(score_, 1, score_, structures(image) & stays & lies_apart);
  cv::min(score_, kMost, score_);
  cv::subtract(score_, 1, score_, changes);
  mask_ = score_ >= kEnough;
  cv::dilate(mask_, mask_, cv::Mat::ones(5, 5, CV_8U));
}

bool Overlay::covers(const Eigen::Vector2d& centre, const Eigen::Vector2d& size) const {
  if (mask_.empty()) return false;
  const Eigen::Vector2d first = centre.array() - 0.5 * size.array() + 0.5;  // of the corners
  const cv::Point from(static_cast<int>(std::lround(first.x())),
                       static_cast<int>(std::lround(first.y())));
  const cv::Size sides(std::max(1, static_cast<int>(std::lround(size.x()))),
                       std::max(1, static_cast<int>(std::lround(size.y()))));
  const cv::Rect box = cv::Rect(from, sides) & cv::Rect({}, mask_.size());
  return 2 * cv::countNonZero(mask_(box)) > box.area();
}

}  // namespace ols::detector
