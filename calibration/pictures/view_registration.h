// Finds the shift of a view relative to a stored picture of the same view, even from another day
// and in different light. Pure.
//
// Orientations of edges are compared, not brightness: of each gradient, only the direction is used,
// weighted by the gradient's strength above the noise. The angle of the direction is doubled: an
// edge that is lit from the other side, whose gradient is reversed, then counts as the same edge.
// First the spectra of the whole pictures are correlated, then those of tiles. Only the majority of
// tiles that agree is used: the other tiles show parts of the scene that have moved.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace ols::calibration {

struct ViewRegistration {
  enum class Refusal {
    kNone,
    kSize,         // the sizes differ or are too small
    kNoStructure,  // too few tiles contain edges: sky, fog or darkness
    kNoAgreement,  // another view, or too much of the scene has moved
  };
  Refusal refusal = Refusal::kNone;
  // Shift [px] from the reference to the view: a point at p in the reference is at p + shift in the
  // view.
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;     // 1-sigma of each component, from the scatter of the tiles
  double agreeing = 0.0;  // share of the structured tiles that agree, 0..1
  int tiles = 0;          // number of structured tiles
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(ViewRegistration::Refusal refusal);

// Both pictures are 8-bit gray and have the same size. The shift may be up to a quarter of that
// size.
ViewRegistration register_view(const cv::Mat& reference, const cv::Mat& view);

}  // namespace ols::calibration
