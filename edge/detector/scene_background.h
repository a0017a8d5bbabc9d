// Estimates the scene without moving objects, as the camera sees it now.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <opencv2/core.hpp>

namespace ols::detector {

// The scene is the median of three images of the last second, each aligned with the present image.
// A moving object covers a given place in only one of the three, and the median therefore shows the
// scene. The estimate is available after 0.25 s, even while the camera moves.
class SceneBackground {
 public:
  void clear() { kept_.clear(); }
  // Takes the camera's motion: `motion` maps the previous image's pixels to the present image's.
  void advance(const Eigen::Matrix3d& motion);
  // Whether at least three images are stored, and the oldest is at least `kLeastAge_s` old.
  bool ready(double time_s) const;
  // The darkest and the brightest grey level within one pixel of each place.
  struct Range {
    cv::Mat low, high;
  };
  // `seen` is 0 at places that one of the three images does not show, and 255 elsewhere.
  struct Scene {
    Range usual;  // range of the median image
    Range ever;   // range over all three images
    cv::Mat seen;
  };
  Scene scene(double time_s) const;
  void remember(const cv::Mat& image, double time_s);

 private:
  static constexpr double kLeastAge_s = 0.25;
  static constexpr double kSpan_s = 0.9;

  struct Kept {
    cv::Mat image;
    double time_s;
    Eigen::Matrix3d to_present;
  };
  const Kept& aged(double age_s, double time_s) const;

  std::deque<Kept> kept_;  // oldest first
};

}  // namespace ols::detector
