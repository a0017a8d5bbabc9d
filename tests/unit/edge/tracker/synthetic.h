// Pictures of a known target in front of a known background, for the tests of the tracker.
#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>

#include "edge/tracker/tracker.h"

namespace ols::tracker::testing {

enum class Backdrop { kTextured, kSky };

// The background is larger than the picture; the camera sees a part of it.
class SyntheticScene {
 public:
  SyntheticScene(Backdrop backdrop, std::uint64_t seed, double noise_sd = 2.0)
      : noise_(seed), noise_sd_(noise_sd) {
    world_ = cv::Mat(1400, 2600, CV_32F, cv::Scalar(150.0));
    if (backdrop == Backdrop::kTextured) {
      cv::RNG texture(7);
      cv::Mat rough(world_.size(), CV_32F);
      texture.fill(rough, cv::RNG::NORMAL, 0.0, 1.0);
      cv::GaussianBlur(rough, rough, cv::Size(0, 0), 2.5);
      cv::normalize(rough, rough, -50.0, 50.0, cv::NORM_MINMAX);
      world_ += rough;
    }
  }

  // `camera`: where the picture's top-left pixel is in the background. `target`: the target's
  // centre in the picture; nullopt: no target.
  cv::Mat picture(const cv::Point2d& camera, const std::optional<cv::Point2d>& target) {
    return picture_of(camera, target, std::nullopt);
  }
  // A picture with two targets that look alike.
  cv::Mat pair(const cv::Point2d& camera, const cv::Point2d& target, const cv::Point2d& other) {
    return picture_of(camera, target, other);
  }

  static cv::Rect2d box_around(const cv::Point2d& centre) {
    return {centre.x + 0.5 - 12.0, centre.y + 0.5 - 9.0, 24.0, 18.0};
  }

  static inline const cv::Size kSize{640, 480};

 private:
  cv::Mat picture_of(const cv::Point2d& camera, const std::optional<cv::Point2d>& target,
                     const std::optional<cv::Point2d>& other) {
    cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, -camera.x, 0, 1, -camera.y);
    cv::Mat image;
    cv::warpAffine(world_, image, shift, kSize, cv::INTER_LINEAR);
    if (target) draw(image, *target);
    if (other) draw(image, *other);
    cv::Mat noise(kSize, CV_32F);
    noise_.fill(noise, cv::RNG::NORMAL, 0.0, noise_sd_);
    image += noise;
    cv::Mat gray;
    image.convertTo(gray, CV_8U);
    return gray;
  }

  // A dark body with a bright spot, smooth enough that its position may be between pixels.
  static void draw(cv::Mat& image, const cv::Point2d& centre) {
    for (int row = 0; row < image.rows; ++row) {
      for (int column = 0; column < image.cols; ++column) {
        const double x = column - centre.x;
        const double y = row - centre.y;
        if (std::abs(x) > 30.0 || std::abs(y) > 30.0) continue;
        const double body = std::exp(-0.5 * (x * x / 25.0 + y * y / 9.0));
        const double spot = std::exp(-0.5 * ((x - 4.0) * (x - 4.0) + y * y) / 3.0);
        float& value = image.at<float>(row, column);
        value += static_cast<float>(body * (40.0 - static_cast<double>(value)) + 90.0 * spot);
      }
    }
  }

  cv::Mat world_;
  cv::RNG noise_;
  double noise_sd_;
};

inline double distance(const Eigen::Vector2d& a, const cv::Point2d& b) {
  return std::hypot(a.x() - b.x, a.y() - b.y);
}

inline Eigen::Matrix3d shift_homography(double x, double y) {
  Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
  shift(0, 2) = x;
  shift(1, 2) = y;
  return shift;
}

// Frames for a tracker, and a tracker that follows the target of a scene.
inline constexpr double kInterval = 1.0 / 15.0;
inline const cv::Point2d kStart(300.0, 220.0);

inline TrackerInput frame_at(int frame, const cv::Mat& gray) {
  return {gray, 100.0 + kInterval * frame, std::nullopt};
}

inline Tracker started(SyntheticScene& scene, const TrackerConfig& config = {}) {
  Tracker tracker(config, 5);
  const auto error = tracker.initialise(frame_at(0, scene.picture({400, 300}, kStart)),
                                        SyntheticScene::box_around(kStart));
  if (error) throw std::runtime_error(to_string(*error));
  return tracker;
}

}  // namespace ols::tracker::testing
