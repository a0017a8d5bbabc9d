#include "edge/tracker/objective.h"

#include <algorithm>
#include <cmath>

namespace ols {
namespace {

// exp(M) for M = 0, 1/255 ... 1.
const std::array<float, 256>& exponentials() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> made{};
    for (std::size_t i = 0; i < made.size(); ++i)
      made[i] = std::exp(static_cast<float>(i) / 255.0F);
    return made;
  }();
  return table;
}

struct Level {
  float mean;
  float deviation;
};

Level level_of(const Patch& patch) {
  float sum = 0.0F;
  float squares = 0.0F;
  for (const float value : patch) {
    sum += value;
    squares += value * value;
  }
  const float mean = sum / kPatchArea;
  return {mean, std::sqrt(std::max(0.0F, squares / kPatchArea - mean * mean))};
}

}  // namespace

Objective::Objective(const Template& target) {
  constexpr float kLeastGain = 0.4F;
  const Level level = level_of(target.gray);
  least_deviation_ = std::max(target.noise, kLeastGain * level.deviation);
  const float deviation = std::max(target.noise, level.deviation);
  for (std::size_t i = 0; i < kPatchArea; ++i) {
    template_[i] = (target.gray[i] - level.mean) / (kUnit * deviation);
  }
}

void Objective::set_mask(const MaskPatch& mask) {
  mask_ = mask;
  has_mask_ = true;
  greatest_ = 0.0;
  for (const std::uint8_t m : mask_) greatest_ += static_cast<double>(exponentials()[m]);
}

double Objective::operator()(const Patch& candidate, const MaskPatch& candidate_mask) const {
  const auto& exponential = exponentials();
  const Level level = level_of(candidate);
  const float scale = 1.0F / (kUnit * std::max(least_deviation_, level.deviation));
  float sum = 0.0F;
  for (std::size_t i = 0; i < kPatchArea; ++i) {
    const float difference = std::abs(template_[i] - (candidate[i] - level.mean) * scale);
    const float alike = 1.0F - std::min(1.0F, difference);
    sum += exponential[std::min(mask_[i], candidate_mask[i])] * alike * alike;
  }
  return static_cast<double>(sum) / greatest_;
}

}  // namespace ols
