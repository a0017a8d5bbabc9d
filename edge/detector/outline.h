// Measures the size of an object in front of smooth surroundings to a fraction of a pixel. A box of
// whole pixels of a pyramid's level is not good enough: its steps look like the beat of wings.
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
// far as it is known. nullopt if it hardly stands out from its surroundings, if it is connected
// with what is further away than that side, or if the edge of the image is that near.
std::optional<Outline> outline_at(const cv::Mat& gray, const Eigen::Vector2d& centre,
                                  double extent_px);

}  // namespace ols::detector
