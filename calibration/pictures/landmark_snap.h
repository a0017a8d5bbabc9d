// Finds the exact position of a landmark to which a person has pointed roughly. Pure.
//
// The position is Foerstner's point (W. Foerstner, E. Guelch, A Fast Operator for Detection and
// Precise Location of Distinct Points, Corners and Centres of Circular Features, 1987): the point
// where the surrounding edges intersect (the tip of a spire, the corner of a roof), or where their
// normals intersect (a ball, a lamp). The better fit is taken.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace ols::calibration {

struct Snap {
  enum class Refusal {
    kNone,
    kOutside,      // too near to the edge of the picture
    kNoStructure,  // no structure above the noise
    kEdge,         // only an edge: the position along it is unknown
    kFar,          // the structure is too far away to be what the person meant
  };
  enum class Shape { kCorner, kCentre };
  Refusal refusal = Refusal::kNone;
  Shape shape = Shape::kCorner;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;  // 1-sigma of the less exact coordinate
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(Snap::Refusal refusal);

// `radius_px`: the largest distance of the structure from the given point, and also its largest
// size.
Snap snap_to_structure(const cv::Mat& gray, const Eigen::Vector2d& pointed_px, double radius_px);

}  // namespace ols::calibration
