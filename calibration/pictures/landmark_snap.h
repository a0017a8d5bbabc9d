// Where a landmark is exactly, that a person has pointed at with a finger's precision. Pure.
//
// Foerstner's point (W. Foerstner, E. Guelch, A Fast Operator for Detection and Precise Location of
// Distinct Points, Corners and Centres of Circular Features, 1987): where the edges around cross,
// or where their normals do, whichever fits better: the tip of a spire, the corner of a roof; a
// ball, a lamp.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace ols::calibration {

struct Snap {
  enum class Refusal {
    kNone,
    kOutside,      // too near to the picture's edge
    kNoStructure,  // nothing there that stands above the noise
    kEdge,         // an edge alone: it says nothing along itself
    kFar,          // the structure lies further away than the person can have meant
  };
  enum class Shape { kCorner, kCentre };
  Refusal refusal = Refusal::kNone;
  Shape shape = Shape::kCorner;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;  // 1-sigma of each coordinate, the larger one
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(Snap::Refusal refusal);

// `radius_px`: how far from the point the structure may be, and how large.
Snap snap_to_structure(const cv::Mat& gray, const Eigen::Vector2d& pointed_px, double radius_px);

}  // namespace ols::calibration
