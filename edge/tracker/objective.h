// The objective function, eq. (5).
#pragma once

#include "edge/tracker/patch.h"

namespace ols {

// Eq. (5) divided by the greatest value it can take for this template, so 0..1. Each patch's
// intensities are counted from their mean in units of their deviation, as long as that does not
// fall far below the template's: a faint target is told from the sky as a strong one is, exposure
// and the sky's gradient do not matter, and noise is not blown up to look like a target. An empty
// mask is all zero.
class Objective {
 public:
  explicit Objective(const Template& target);

  // M_t, estimated once.
  void set_mask(const MaskPatch& mask);
  bool has_mask() const { return has_mask_; }
  const MaskPatch& mask() const { return mask_; }

  double operator()(const Patch& candidate, const MaskPatch& candidate_mask) const;

 private:
  static constexpr float kUnit = 2.0F;  // deviations that are the difference 1 of eq. (5)

  Patch template_{};  // normalised
  float least_deviation_ = 1.0F;
  MaskPatch mask_{};
  bool has_mask_ = false;
  double greatest_ = kPatchArea;
};

}  // namespace ols
