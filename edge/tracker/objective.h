// The objective function, eq. (5).
#pragma once

#include <array>
#include <cmath>

#include "edge/tracker/patch.h"

namespace ols::tracker {

// exp(M) of a mask's 0, 1/255 ... 1: eq. (5)'s weights.
template <typename Number>
const std::array<Number, 256>& exponentials() {
  static const std::array<Number, 256> table = [] {
    std::array<Number, 256> made{};
    for (std::size_t i = 0; i < made.size(); ++i) {
      made[i] = std::exp(static_cast<Number>(i) / static_cast<Number>(255));
    }
    return made;
  }();
  return table;
}

struct Similarity {
  double similarity = 0.0;         // eq. (5), 0..1
  double correlation = 0.0;        // of the grey values with the first or the learnt image, -1..1
  double first_correlation = 0.0;  // with the first image
  double contrast = 0.0;           // deviation of the grey values, the template's being 1
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

  // Takes the target's present look into the learnt image, by this share.
  void learn(const Patch& gray, double share);

  Similarity operator()(const Patch& gray, const MaskPatch& candidate_mask) const;

 private:
  // A warm target before a sky that grows warmer turns from bright to dark: as like, but rarer.
  static constexpr float kInverted = 0.9F;
  static constexpr Patch ones() {
    Patch patch{};
    for (float& value : patch) value = 1.0F;
    return patch;
  }
  static constexpr float kUnit = 2.0F;  // deviations that are the difference 1 of eq. (5)

  Patch template_{};        // normalised
  Patch learnt_{};          // likewise: how it looked of late
  float deviation_ = 1.0F;  // the template's [grey levels]
  float least_deviation_ = 1.0F;
  Patch exponential_ = ones();  // exp(M_t)
  double greatest_ = kPatchArea;
};

}  // namespace ols::tracker
