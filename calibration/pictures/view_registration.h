// Finds the shift of a view relative to a stored picture of the same view, even from another day
// and in different light. Pure.
//
// Edge orientations are compared, not brightness: only the direction of each gradient counts,
// weighted by its strength above the noise. The angle of the direction is doubled, so that an edge
// lit from the other side is the same edge. The spectra of the whole pictures are correlated first,
// then those of tiles. Only the tiles that agree count, because moved parts of the scene are a
// minority.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace ols::calibration {

struct ViewRegistration {
  enum class Refusal {
    kNone,
    kSize,         // the sizes differ or are too small
    kNoStructure,  // too few tiles contain edges: sky, fog, darkness
    kNoAgreement,  // another view, or too much of it has moved
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
