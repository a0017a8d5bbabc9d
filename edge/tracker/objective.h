// The objective function, eq. (5).
#pragma once

#include <array>
#include <cmath>

#include "edge/tracker/patch.h"

namespace ols::tracker {

// exp(M) for a mask value M of 0, 1/255 ... 1: the weights of eq. (5).
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
  double similarity = 0.0;   // eq. (5), 0..1
  double correlation = 0.0;  // with the first or with the learnt image, whichever is greater; -1..1
  double contrast = 0.0;     // standard deviation of the grey values, relative to the template's
};

// Eq. (5) divided by its maximum for this template, so that it is 0..1. Each patch is normalised:
// its mean is subtracted, and the result is divided by its standard deviation. Therefore, faint
// targets are distinguished from the sky as reliably as strong ones, and neither the exposure nor
// the sky's gradients matter. The divisor has a lower limit, derived from the template, so that
// noise is not amplified into a target. An empty mask counts as zero everywhere.
class Objective {
 public:
  explicit Objective(const Template& target);

  void set_mask(const MaskPatch& mask);  // M_t

  // Learns the target's present appearance with this weight.
  void learn(const Patch& gray, double share);

  Similarity operator()(const Patch& gray, const MaskPatch& candidate_mask) const;

 private:
  // Factor for the correlation of an inverted patch. Inversion is possible, but rare: in infrared
  // light, a warm target changes from bright to dark if the sky behind it becomes warmer.
  static constexpr float kInverted = 0.9F;
  static constexpr Patch ones() {
    Patch patch{};
    for (float& value : patch) value = 1.0F;
    return patch;
  }
  // A difference of this number of standard deviations counts as 1 in eq. (5).
  static constexpr float kUnit = 2.0F;

  Patch template_{};        // normalised
  Patch learnt_{};          // normalised; the recent appearance
  float deviation_ = 1.0F;  // [grey levels] standard deviation of the template
  float least_deviation_ = 1.0F;
  Patch exponential_ = ones();  // exp(M_t)
  double greatest_ = kPatchArea;
};

}  // namespace ols::tracker
