// What one image shows: a place that differs from its surroundings or from the scene.
#pragma once

#include <Eigen/Core>

namespace ols::detector {

enum class Evidence {
  kSpot,   // compact, before a smooth surrounding such as the sky
  kMover,  // differs from the aligned scene of a moment ago
};

struct Detection {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();    // its centre, full-frame pixels
  Eigen::Vector2d size_px = Eigen::Vector2d::Zero();  // width and height of its box
  double signal_to_noise = 0.0;                       // of its peak
  bool brighter = false;                              // than its surroundings or the scene
  Evidence evidence = Evidence::kSpot;
  bool clear = false;    // a spot: there is nothing like it in the wider surroundings either
  double sd_px() const;  // of its position, each axis
};

}  // namespace ols::detector
