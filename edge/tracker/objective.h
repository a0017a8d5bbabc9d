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
  double correlation = 0.0;  // between the grey values and the first or the learnt image, -1..1
  double contrast = 0.0;     // deviation of the grey values, relative to that of the template
};

// Eq. (5) divided by its maximum for this template, so that it is 0..1. The intensities of each
// patch are taken relative to their mean, in units of their deviation. A faint target is therefore
// distinguished from the sky as well as a strong one, and exposure and gradients of the sky do not
// matter. The unit has a lower limit, derived from the template, so that noise is not amplified
// into a target. An empty mask counts as zero everywhere.
class Objective {
 public:
  explicit Objective(const Template& target);

  void set_mask(const MaskPatch& mask);  // M_t

  // Learns the target's present appearance with this weight.
  void learn(const Patch& gray, double share);

  Similarity operator()(const Patch& gray, const MaskPatch& candidate_mask) const;

 private:
  // Factor for the similarity of an inverted patch. A warm target in front of a warming sky does
  // change from bright to dark, but rarely.
  static constexpr float kInverted = 0.9F;
  static constexpr Patch ones() {
    Patch patch{};
    for (float& value : patch) value = 1.0F;
    return patch;
  }
  // Number of deviations that give a difference of 1 in eq. (5)
  static constexpr float kUnit = 2.0F;

  Patch template_{};        // normalised
  Patch learnt_{};          // normalised; its recent appearance
  float deviation_ = 1.0F;  // deviation of the template [grey levels]
  float least_deviation_ = 1.0F;
  Patch exponential_ = ones();  // exp(M_t)
  double greatest_ = kPatchArea;
};

}  // namespace ols::tracker
