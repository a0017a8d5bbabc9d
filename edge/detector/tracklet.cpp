#include "edge/detector/tracklet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "edge/tracker/particle.h"

namespace ols::detector {
namespace {

constexpr double kLearning = 0.2;  // of size and signal, for each image

}  // namespace

Tracklet::Tracklet(long id, const Detection& detection, double image_width_px)
    : id_(id),
      pixel_(detection.pixel),
      size_px_(detection.size_px),
      origin_(detection.pixel),
      mark_(detection.pixel),
      rest_(detection.pixel),
      star_(detection.pixel),
      first_pixel_(detection.pixel),
      marked_pixel_(detection.pixel),
      measured_pixel_(detection.pixel),
      measured_sd_px_(detection.sd_px()),
      measured_size_px_(detection.size_px),
      acceleration_px_s2_(0.4 * image_width_px),
      signal_to_noise_(detection.signal_to_noise),
      brighter_(detection.brighter) {
  begin_motion(detection, image_width_px);
  clear_ = detection.clear ? 1 : 0;
  if (detection.path) path_ = detection.path->id;
}

void Tracklet::begin_motion(const Detection& detection, double image_width_px) {
  const double speed_px_s = 0.25 * image_width_px;
  const double sd_px = detection.sd_px();
  pixel_ = detection.pixel;
  velocity_px_s_.setZero();
  covariance_ << sd_px * sd_px, 0.0, 0.0, speed_px_s * speed_px_s;
  if (!detection.path) return;
  constexpr double kPathSpeed_px_s = 5.0;  // a path's error
  velocity_px_s_ = detection.path->velocity_px_s;
  covariance_(1, 1) = kPathSpeed_px_s * kPathSpeed_px_s;
}

void Tracklet::predict(const Eigen::Matrix3d& motion, double interval_s,
                       const std::optional<Eigen::Matrix3d>& star_motion) {
  const Eigen::Vector2d moved = tracker::transform(motion, pixel_);
  velocity_px_s_ =
      tracker::transform(motion, Eigen::Vector2d(pixel_ + velocity_px_s_ * interval_s)) - moved;
  if (interval_s > 0.0) velocity_px_s_ /= interval_s;
  pixel_ = moved + velocity_px_s_ * interval_s;
  star_ = tracker::transform(star_motion.value_or(motion), star_);
  for (Eigen::Vector2d* const at : {&origin_, &mark_, &rest_})
    *at = tracker::transform(motion, *at);
  Eigen::Matrix2d step;
  step << 1.0, interval_s, 0.0, 1.0;
  const Eigen::Vector2d push(0.5 * interval_s * interval_s, interval_s);
  covariance_ = step * covariance_ * step.transpose() +
                push * push.transpose() * acceleration_px_s2_ * acceleration_px_s2_;
  covariance_(0, 0) += 0.04;  // the camera's motion is known to a fifth of a pixel
  unseen_s_ += interval_s;
  age_s_ += interval_s;
  measure_way(interval_s);
}

// In steps of a moment, so that the jitter of single images does not lengthen the paths.
void Tracklet::measure_way(double interval_s) {
  constexpr double kStep_s = 0.2, kRest_s = 3.0;
  constexpr double kStill_px = 1.0;  // of the scene in a step: may be the error of its motion
  way_s_ += interval_s;
  if ((marked_s_ += interval_s) >= kStep_s) {
    path_px_ += (pixel_ - mark_).norm();
    const double scene_px = (mark_ - marked_pixel_).norm();
    if (scene_px > kStill_px) scene_path_px_ += scene_px;
    mark_ = marked_pixel_ = pixel_;
    marked_s_ = 0.0;
  }
  if ((rested_s_ += interval_s) >= kRest_s) {
    rests_ = (pixel_ - rest_).norm() < 2.0 + 0.1 * size_px_.minCoeff();
    rest_ = pixel_;
    rested_s_ = 0.0;
  }
}

void Tracklet::forget_way() {
  origin_ = mark_ = rest_ = star_ = first_pixel_ = marked_pixel_ = pixel_;
  path_px_ = scene_path_px_ = reach_px_ = way_s_ = rested_s_ = marked_s_ = 0.0;
  rests_ = false;
}

double Tracklet::innovation_variance(const Detection& detection) const {
  return covariance_(0, 0) + detection.sd_px() * detection.sd_px();
}

double Tracklet::distance(const Detection& detection) const {
  return (detection.pixel - pixel_).squaredNorm() / innovation_variance(detection);
}

double Tracklet::density(const Detection& detection) const {
  return std::exp(-0.5 * distance(detection)) /
         (2.0 * std::numbers::pi * innovation_variance(detection));
}

void Tracklet::correct(const Eigen::Vector2d& pixel, double variance_px2) {
  const Eigen::Vector2d gain = covariance_.col(0) / (covariance_(0, 0) + variance_px2);
  const Eigen::Vector2d off = pixel - pixel_;
  pixel_ += gain(0) * off;
  velocity_px_s_ += gain(1) * off;
  covariance_ -= gain * covariance_.row(0).eval();
}

void Tracklet::update(const Detection& detection) {
  correct(detection.pixel, detection.sd_px() * detection.sd_px());
  count(detection);
}

void Tracklet::recognised(const Eigen::Vector2d& pixel) {
  const double sd_px = Detection{pixel, size_px_}.sd_px();  // as exact as a spot
  correct(pixel, sd_px * sd_px);
  be_seen_at(pixel, sd_px);
}

void Tracklet::compare_size(const Detection& detection) {
  constexpr double kMost = 1.5;    // of the areas' ratio
  constexpr double kAside = 0.25;  // of the size
  const double ratio = detection.size_px.prod() / size_px_.prod();
  const Eigen::Vector2d off = (detection.pixel - pixel_).cwiseQuotient(size_px_);
  if (ratio < kMost && ratio > 1.0 / kMost && off.cwiseAbs().maxCoeff() < kAside)
    size_px_ += kLearning * (detection.size_px - size_px_);
}

void Tracklet::leap(const Detection& detection, double image_width_px) {
  begin_motion(detection, image_width_px);
  count(detection);
}

bool Tracklet::resembles(const Detection& detection) const {
  constexpr double kMost = 4.0;  // of the areas' ratio
  const double ratio = std::max(1.0, detection.size_px.prod()) / std::max(1.0, size_px_.prod());
  return detection.brighter == brighter_ && ratio < kMost && ratio > 1.0 / kMost;
}

void Tracklet::count(const Detection& detection) {
  size_px_ += kLearning * (detection.size_px - size_px_);
  signal_to_noise_ += kLearning * (detection.signal_to_noise - signal_to_noise_);
  measured_size_px_ = detection.size_px;
  ++detections_;
  if (detection.clear) ++clear_;
  if (detection.path) path_ = detection.path->id;
  be_seen_at(detection.pixel, detection.sd_px());
}

void Tracklet::be_seen_at(const Eigen::Vector2d& pixel, double sd_px) {
  measured_pixel_ = pixel;
  measured_sd_px_ = sd_px;
  unseen_s_ = 0.0;
  unseen_images_ = 0;
  seen_ = true;
  reach_px_ = std::max(reach_px_, (pixel_ - first_pixel_).norm());
}

void Tracklet::measure_outline(const cv::Mat& gray) {
  outline_.reset();
  if (seen_) outline_ = outline_at(gray, measured_pixel_, measured_size_px_.maxCoeff());
}

void Tracklet::confirm(bool before_sky) {
  confirmed_ = true;
  confirmed_clear_ = confirmed_clear_ || (before_sky && mostly_clear());
}

void Tracklet::weigh(double log_ratio, double most) {
  log_ratio_ = std::min(log_ratio_ + log_ratio, most);
}

}  // namespace ols::detector
