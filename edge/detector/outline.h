// Measures the size of an object against a smooth background to a fraction of a pixel. A box of
// whole pixels in a level of the pyramid is not good enough, because its steps look like a wing
// beat.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace ols::detector {

struct Outline {
  // Width and height of the upright box around the ellipse that has the second moments of the
  // object's contrast, in pixels.
  Eigen::Vector2d size_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d sd_px = Eigen::Vector2d::Zero();  // 1-sigma due to the noise of the image
};

// `gray`: 8-bit, one channel. `centre`, `extent_px`: where the object is, and its largest side as
// far as it is known. nullopt if the object hardly stands out from its surroundings, if it is
// connected with something further away than that side, or if the edge of the image is nearer than
// that.
std::optional<Outline> outline_at(const cv::Mat& gray, const Eigen::Vector2d& centre,
                                  double extent_px);

}  // namespace ols::detector
