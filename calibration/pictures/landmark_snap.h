// Finds the exact position of a landmark to which a person has pointed roughly. Pure.
//
// The position is Foerstner's point (W. Foerstner, E. Guelch, A Fast Operator for Detection and
// Precise Location of Distinct Points, Corners and Centres of Circular Features, 1987): the point
// where the surrounding edges intersect (the tip of a spire, the corner of a roof), or where the
// edges' normals intersect (a ball, a lamp). Of the two, the point that fits better is taken.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace ols::calibration {

struct Snap {
  enum class Refusal {
    kNone,
    kOutside,      // too near the border of the picture
    kNoStructure,  // no structure above the noise
    kEdge,         // only one edge: the position along it is unknown
    kFar,          // the structure is too far from where the person has pointed
  };
  enum class Shape { kCorner, kCentre };
  Refusal refusal = Refusal::kNone;
  Shape shape = Shape::kCorner;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;  // 1-sigma of the less exact coordinate
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(Snap::Refusal refusal);

// `radius_px`: the largest distance of the structure from pointed_px, and also the structure's
// largest size.
Snap snap_to_structure(const cv::Mat& gray, const Eigen::Vector2d& pointed_px, double radius_px);

}  // namespace ols::calibration
