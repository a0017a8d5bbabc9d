// A possible object: its motion in the image, and the evidence that it exists.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "edge/detector/detection.h"
#include "edge/detector/outline.h"

namespace ols::detector {

// The model is constant velocity, in full-frame pixels and seconds. The two axes share one
// covariance.
class Tracklet {
 public:
  Tracklet(long id, const Detection& detection, double image_width_px);

  // Predicts the state for the next image; `motion` maps pixels of the previous image to that
  // image, and `star_motion` those of a star.
  void predict(const Eigen::Matrix3d& motion, double interval_s,
               const std::optional<Eigen::Matrix3d>& star_motion = std::nullopt);
  void update(const Detection& detection);
  // Notes that the object was found again at another place than predicted: position and velocity
  // begin anew.
  void leap(const Detection& detection, double image_width_px);
  void miss() {
    seen_ = false;
    ++unseen_images_;
  }

  // Whether the detection has the same polarity and about the same size.
  bool resembles(const Detection& detection) const;
  // Squared distance to the detection in standard deviations, and the probability density of that
  // deviation [1/px^2].
  double distance(const Detection& detection) const;
  double density(const Detection& detection) const;

  // The sequential test: adds to the log likelihood ratio of object against clutter, which may grow
  // to `most`.
  void weigh(double log_ratio, double most);
  double log_ratio() const { return log_ratio_; }
  void confirm(bool before_sky);
  void doubt() { confirmed_ = false; }
  bool confirmed() const { return confirmed_; }
  bool confirmed_clear() const { return confirmed_clear_; }  // it was confirmed by clear spots

  long id() const { return id_; }
  const Eigen::Vector2d& pixel() const { return pixel_; }
  const Eigen::Vector2d& velocity_px_s() const { return velocity_px_s_; }
  double velocity_sd_px_s() const { return std::sqrt(covariance_(1, 1)); }  // for each axis
  // The newest detection: its pixel, its standard deviation on each axis, and its size.
  const Eigen::Vector2d& measured_pixel() const { return measured_pixel_; }
  double measured_sd_px() const { return measured_sd_px_; }
  const Eigen::Vector2d& measured_size_px() const { return measured_size_px_; }
  const Eigen::Vector2d& size_px() const { return size_px_; }  // smoothed
  // The outline of the newest detection, from measure_outline(); nullopt if it has no clear
  // outline.
  const std::optional<Outline>& outline() const { return outline_; }
  void measure_outline(const cv::Mat& gray);
  double signal_to_noise() const { return signal_to_noise_; }
  // The point that stacks of images have last shown here, and the number of images without any
  // detection; nullopt if only single images show it.
  const std::optional<long>& path() const { return path_; }
  int unseen_images() const { return unseen_images_; }
  bool seen() const { return seen_; }  // whether the newest image shows it
  double unseen_s() const { return unseen_s_; }
  double age_s() const { return age_s_; }
  bool mostly_clear() const { return clear_ > 0.7 * detections_; }
  // The distance from the place where it began, and the length of its path from there; both without
  // the camera's motion.
  double way_px() const { return (pixel_ - origin_).norm(); }
  double path_px() const { return path_px_ + (pixel_ - mark_).norm(); }
  // scene_shift_px: how far the scene has moved in the image since the tracklet began. reach_px:
  // the largest distance, in the image, from the place where it began.
  double scene_shift_px() const { return (origin_ - first_pixel_).norm(); }
  double reach_px() const { return reach_px_; }
  // The distance from where a star would be that was at the place where it began.
  double off_star_px() const { return (pixel_ - star_).norm(); }
  // How far that star has moved relative to the scene.
  double star_path_px() const { return (star_ - origin_).norm(); }
  // Whether it has not moved relative to the scene in the last seconds.
  bool rests() const { return rests_; }
  // Forgets its motion so far, because the camera's motion was unknown.
  void forget_way();

 private:
  void begin_motion(const Detection& detection, double image_width_px);
  void count(const Detection& detection);
  void measure_way(double interval_s);
  double innovation_variance(const Detection& detection) const;

  long id_;
  Eigen::Vector2d pixel_, velocity_px_s_ = Eigen::Vector2d::Zero(), size_px_;
  // The places where it began, where it was a moment ago, and where it was a second ago; all three
  // move with the scene.
  Eigen::Vector2d origin_, mark_, rest_;
  Eigen::Vector2d star_;         // where a star would be that was at origin_ when it began
  Eigen::Vector2d first_pixel_;  // place in the image where it began
  Eigen::Vector2d measured_pixel_;
  double measured_sd_px_;
  Eigen::Vector2d measured_size_px_;
  std::optional<Outline> outline_;
  double reach_px_ = 0.0;
  double marked_s_ = 0.0, rested_s_ = 0.0;  // how long mark_ and rest_ have been kept
  double path_px_ = 0.0;                    // length up to the mark
  Eigen::Matrix2d covariance_;              // of position and velocity, on each axis
  double acceleration_px_s2_;               // standard deviation
  double signal_to_noise_;
  bool brighter_;
  double log_ratio_ = 0.0, unseen_s_ = 0.0, age_s_ = 0.0;
  int detections_ = 1, clear_ = 0, unseen_images_ = 0;
  std::optional<long> path_;
  bool confirmed_ = false, confirmed_clear_ = false, seen_ = true, rests_ = false;
};

}  // namespace ols::detector
