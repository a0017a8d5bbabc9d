// By how much a view has moved against a stored picture of the same view: of a reference view of
// another day, under other light. Pure.
//
// What is compared is the orientation of edges, not brightness: each gradient counts with its
// direction alone (doubled, so that an edge lit from the other side is the same edge), weighted by
// how far it stands above the noise. Correlated as a whole by their spectra, then in tiles, of
// which those that agree count: what has moved in the scene is in the minority.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace ols::calibration {

struct ViewRegistration {
  enum class Refusal {
    kNone,
    kSize,         // the two pictures are not of one size, or too small
    kNoStructure,  // sky, fog, darkness: too few tiles with edges
    kNoAgreement,  // another view, or too much of it has moved
  };
  Refusal refusal = Refusal::kNone;
  // [px] from the reference to the view: what was at p is at p + shift.
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;     // 1-sigma of each component, from the scatter of the tiles
  double agreeing = 0.0;  // share of the tiles with structure that agree, 0..1
  int tiles = 0;          // with structure
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(ViewRegistration::Refusal refusal);

// Both 8-bit gray, of one size; the shift may be up to a quarter of it.
ViewRegistration register_view(const cv::Mat& reference, const cv::Mat& view);

}  // namespace ols::calibration
