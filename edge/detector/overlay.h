// What belongs to the camera and not to the scene: a burnt-in text, a reticle, a speck on the lens.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace ols::detector {

// Learns which pixels keep their grey level at their place in the image while the scene moves on.
class Overlay {
 public:
  // `image`: 8-bit, one channel, always of the same size; it is kept. `motion` maps the previous
  // image's pixels to this one's, as measured with the images; `predicted`: the same according to
  // the mount. nullopt: unknown. Returns whether the mount turns and the picture rests: then all
  // corners are the overlay's, and the motion was not the scene's.
  bool advance(const cv::Mat& image, const std::optional<Eigen::Matrix3d>& motion,
               const std::optional<Eigen::Matrix3d>& predicted);
  // Whether most of a box lies on it; in pixels of the image.
  bool covers(const Eigen::Vector2d& centre, const Eigen::Vector2d& size) const;
  // 255 at the overlay and within two pixels of it, else 0; empty before the scene has moved.
  const cv::Mat& mask() const { return mask_; }

 private:
  void restart(const cv::Mat& image);
  void count(const cv::Mat& image, const Eigen::Matrix3d& moved);

  cv::Mat earlier_;  // an earlier image
  // How the scene has moved since then, by the images and by the mount.
  Eigen::Matrix3d moved_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d predicted_ = Eigen::Matrix3d::Identity();
  cv::Mat score_;  // CV_8U: how often a pixel has stayed, less how often it has changed
  cv::Mat mask_;
};

}  // namespace ols::detector
