// The objective function, eq. (5).
#pragma once

#include "edge/tracker/patch.h"

namespace ols {

struct Likeness {
  double similarity = 0.0;   // eq. (5), 0..1
  double correlation = 0.0;  // of the grey values, -1..1
  double contrast = 0.0;     // deviation of the grey values, the template's being 1
};

// Eq. (5) divided by the greatest value it can take for this template, so 0..1. Each patch's
// intensities are counted from their mean in units of their deviation, as long as that does not
// fall far below the template's: a faint target is told from the sky as a strong one is, exposure
// and the sky's gradient do not matter, and noise is not blown up to look like a target. An empty
// mask is all zero.
class Objective {
 public:
  explicit Objective(const Template& target);

  void set_mask(const MaskPatch& mask);  // M_t

  Likeness operator()(const Patch& gray, const MaskPatch& candidate_mask) const;

 private:
  static constexpr float kUnit = 2.0F;  // deviations that are the difference 1 of eq. (5)

  Patch template_{};        // normalised
  float deviation_ = 1.0F;  // the template's [grey levels]
  float least_deviation_ = 1.0F;
  MaskPatch mask_{};
  double greatest_ = kPatchArea;
};

}  // namespace ols
