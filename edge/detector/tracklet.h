// A tracklet is a possible object: its motion in the image, and the evidence that it exists.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "edge/detector/detection.h"
#include "edge/detector/outline.h"

namespace ols::detector {

// A Kalman filter with constant velocity relative to the scene, in full-frame pixels and seconds.
// Both axes have the same covariance.
class Tracklet {
 public:
  Tracklet(long id, const Detection& detection, double image_width_px);

  // Predicts the state for the next image. `motion` maps the scene's pixels in the previous image
  // to those in the next one; `star_motion` does the same for stars.
  void predict(const Eigen::Matrix3d& motion, double interval_s,
               const std::optional<Eigen::Matrix3d>& star_motion = std::nullopt);
  void update(const Detection& detection);
  // Call instead of update() if the object was found at another place than predicted: position and
  // velocity begin anew.
  void leap(const Detection& detection, double image_width_px);
  void miss() {
    seen_ = false;
    ++unseen_images_;
  }

  // Call instead of update() if the object was recognised at this pixel by its appearance.
  void recognised(const Eigen::Vector2d& pixel);
  // Takes the size of a detection that has about the object's size and place. Another one shows
  // only a part of the object, or what is beside it, too.
  void compare_size(const Detection& detection);

  // Whether the detection has about the tracklet's size, and differs from its surroundings in the
  // same direction (brighter or darker).
  bool resembles(const Detection& detection) const;
  // distance(): the squared distance between prediction and detection, divided by its variance.
  // density(): the predicted probability density at the detection [1/px^2].
  double distance(const Detection& detection) const;
  double density(const Detection& detection) const;

  // The sequential test: adds `log_ratio` to the logarithm of the likelihood ratio of object to
  // clutter. The sum is limited to `most`.
  void weigh(double log_ratio, double most);
  double log_ratio() const { return log_ratio_; }
  void confirm(bool before_sky);
  void doubt() { confirmed_ = false; }
  bool confirmed() const { return confirmed_; }
  bool confirmed_clear() const { return confirmed_clear_; }  // clear spots have confirmed it

  long id() const { return id_; }
  const Eigen::Vector2d& pixel() const { return pixel_; }
  const Eigen::Vector2d& velocity_px_s() const { return velocity_px_s_; }
  double velocity_sd_px_s() const { return std::sqrt(covariance_(1, 1)); }  // on each axis
  // measured_pixel(), measured_sd_px(): where the object was last detected or recognised, and the
  // 1-sigma of that on each axis. measured_size_px(): the size of its last detection.
  const Eigen::Vector2d& measured_pixel() const { return measured_pixel_; }
  double measured_sd_px() const { return measured_sd_px_; }
  const Eigen::Vector2d& measured_size_px() const { return measured_size_px_; }
  const Eigen::Vector2d& size_px() const { return size_px_; }  // smoothed
  // The outline that measure_outline() found for the newest detection; nullopt if there is none.
  const std::optional<Outline>& outline() const { return outline_; }
  void measure_outline(const cv::Mat& gray);
  double signal_to_noise() const { return signal_to_noise_; }
  // path(): the id of the dim point that stacks of images show here; nullopt if only single images
  // show the object. unseen_images(): the number of images since its last detection.
  const std::optional<long>& path() const { return path_; }
  int unseen_images() const { return unseen_images_; }
  bool seen() const { return seen_; }  // whether it was detected or recognised in the newest image
  double unseen_s() const { return unseen_s_; }
  double age_s() const { return age_s_; }
  bool mostly_clear() const { return clear_ > 0.7 * detections_; }
  // The distance from the place where it began, and the length of its path from there; both
  // relative to the scene.
  double way_px() const { return (pixel_ - origin_).norm(); }
  double path_px() const { return path_px_ + (pixel_ - mark_).norm(); }
  // scene_shift_px(): how far the scene has moved in the image since the tracklet began.
  // reach_px(): its largest distance so far from the pixel where it began.
  double scene_shift_px() const { return (origin_ - first_pixel_).norm(); }
  // scene_path_px(): the length of the scene's path in the image, in steps of 0.2 s, without those
  // of less than a pixel. way_s(): over what time way_px() was made [s].
  double scene_path_px() const { return scene_path_px_; }
  double way_s() const { return way_s_; }
  double reach_px() const { return reach_px_; }
  // The tracklet's distance from an imagined star, which was at the tracklet's first place when the
  // tracklet began.
  double off_star_px() const { return (pixel_ - star_).norm(); }
  // How far that star has moved since then, relative to the scene.
  double star_path_px() const { return (star_ - origin_).norm(); }
  // Whether it has hardly moved relative to the scene during the last three seconds.
  bool rests() const { return rests_; }
  // Call if the camera's motion was unknown: the path begins anew at the present place.
  void forget_way();

 private:
  void begin_motion(const Detection& detection, double image_width_px);
  void count(const Detection& detection);
  void be_seen_at(const Eigen::Vector2d& pixel, double sd_px);
  void measure_way(double interval_s);
  double innovation_variance(const Detection& detection) const;
  void correct(const Eigen::Vector2d& pixel, double variance_px2);

  long id_;
  Eigen::Vector2d pixel_, velocity_px_s_ = Eigen::Vector2d::Zero(), size_px_;
  // The places where it began (origin_), where it was at the last mark, at most 0.2 s ago (mark_),
  // and where it was at most three seconds ago (rest_). All three move with the scene.
  Eigen::Vector2d origin_, mark_, rest_;
  // Present place of an imagined star that was at the tracklet's first place.
  Eigen::Vector2d star_;
  Eigen::Vector2d first_pixel_;   // the pixel where it began
  Eigen::Vector2d marked_pixel_;  // the pixel where it was at the last mark
  Eigen::Vector2d measured_pixel_;
  double measured_sd_px_;
  Eigen::Vector2d measured_size_px_;
  std::optional<Outline> outline_;
  double reach_px_ = 0.0;
  double way_s_ = 0.0, marked_s_ = 0.0, rested_s_ = 0.0;  // ages of origin_, mark_ and rest_
  double path_px_ = 0.0;                                  // length of the path up to mark_
  double scene_path_px_ = 0.0;  // length of the scene's path up to the last mark
  Eigen::Matrix2d covariance_;  // of position and velocity; the same for both axes
  double acceleration_px_s2_;   // standard deviation of the acceleration
  double signal_to_noise_;
  bool brighter_;
  double log_ratio_ = 0.0, unseen_s_ = 0.0, age_s_ = 0.0;
  int detections_ = 1, clear_ = 0, unseen_images_ = 0;
  std::optional<long> path_;
  bool confirmed_ = false, confirmed_clear_ = false, seen_ = true, rests_ = false;
};

}  // namespace ols::detector
