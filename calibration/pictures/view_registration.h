// The shift of a view against a stored picture of the same view, for example a reference view of
// another day under other light. Pure.
//
// Edge orientations are compared, not brightness. Only the direction of each gradient counts
// (doubled, so that an edge lit from the other side is the same edge), weighted by how far it is
// above the noise. The whole pictures are correlated by their spectra, then tiles. Only the tiles
// that agree count, because what has moved in the scene is a minority.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace ols::calibration {

struct ViewRegistration {
  enum class Refusal {
    kNone,
    kSize,         // different or too small sizes
    kNoStructure,  // sky, fog, darkness: too few tiles with edges
    kNoAgreement,  // another view, or too much of it has moved
  };
  Refusal refusal = Refusal::kNone;
  // [px] from the reference to the view: a point at p is now at p + shift.
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;     // 1-sigma of each component, from the scatter of the tiles
  double agreeing = 0.0;  // share of the structured tiles that agree, 0..1
  int tiles = 0;          // number of structured tiles
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(ViewRegistration::Refusal refusal);

// Both 8-bit gray, of one size. The shift may be up to a quarter of it.
ViewRegistration register_view(const cv::Mat& reference, const cv::Mat& view);

}  // namespace ols::calibration
