// A detection in one image: a place that differs from its surroundings or from the scene.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace ols::detector {

enum class Evidence {
  kSpot,   // a compact spot against a smooth background, such as the sky
  kMover,  // a part of the image that differs from the aligned images of the last second
  kStack,  // a point that is visible only in a sum of images, each shifted along the point's path
};

// The path of a point that is followed through stacks of images.
struct Path {
  long id;                        // number of the point
  Eigen::Vector2d velocity_px_s;  // relative to the scene
};

struct Detection {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();    // centre, in pixels of the full frame
  Eigen::Vector2d size_px = Eigen::Vector2d::Zero();  // width and height of its box
  double signal_to_noise = 0.0;                       // signal-to-noise ratio of its peak
  bool brighter = false;  // brighter than its surroundings; always false for a kMover
  Evidence evidence = Evidence::kSpot;
  bool clear = false;                       // a spot with nothing similar in its wider surroundings
  std::optional<Path> path = std::nullopt;  // only of a kStack
  double sd_px() const;                     // 1-sigma of its position on each axis
};

}  // namespace ols::detector
