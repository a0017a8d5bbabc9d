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

// Partial sums that a compiler may keep in one register; their order is fixed.
constexpr std::size_t kLanes = 8;
using Lanes = std::array<float, kLanes>;

float total(const Lanes& lanes) {
  return ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) +
         ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]));
}

struct Level {
  float mean;
  float deviation;
};

Level level_of(const Patch& patch) {
  Lanes sums{}, squares{};
  for (std::size_t i = 0; i < kPatchArea; i += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      sums[k] += patch[i + k];
      squares[k] += patch[i + k] * patch[i + k];
    }
  }
  const float mean = total(sums) / kPatchArea;
  return {mean, std::sqrt(std::max(0.0F, total(squares) / kPatchArea - mean * mean))};
}

}  // namespace

Objective::Objective(const Template& target) {
  constexpr float kLeastGain = 0.15F;
  const Patch& gray = target.gray;
  const Level level = level_of(gray);
  least_deviation_ = std::max(0.5F * target.noise, kLeastGain * level.deviation);
  deviation_ = std::max(0.5F * target.noise, level.deviation);
  for (std::size_t i = 0; i < kPatchArea; ++i) {
    template_[i] = (gray[i] - level.mean) / (kUnit * deviation_);
  }
  learnt_ = template_;
}

void Objective::learn(const Patch& gray, double share) {
  const Level level = level_of(gray);
  float scale = 1.0F / (kUnit * std::max(least_deviation_, level.deviation));
  float product = 0.0F;
  for (std::size_t i = 0; i < kPatchArea; ++i) product += learnt_[i] * (gray[i] - level.mean);
  if (product < 0.0F) {  // dark where it was bright: the background's brightness has passed its own
    for (float& value : learnt_) value = -value;
  }
  const auto part = static_cast<float>(share);
  for (std::size_t i = 0; i < kPatchArea; ++i) {
    learnt_[i] += part * ((gray[i] - level.mean) * scale - learnt_[i]);
  }
  const float gain = 1.0F / (kUnit * std::max(0.1F / kUnit, level_of(learnt_).deviation));
  for (float& value : learnt_) value *= gain;
}

void Objective::set_mask(const MaskPatch& mask) {
  greatest_ = 0.0;
  for (std::size_t i = 0; i < kPatchArea; ++i) {
    exponential_[i] = exponentials()[mask[i]];
    greatest_ += static_cast<double>(exponential_[i]);
  }
}

Likeness Objective::operator()(const Patch& gray, const MaskPatch& candidate_mask) const {
  const auto& exponential = exponentials();
  Patch weight;
  for (std::size_t i = 0; i < kPatchArea; ++i) weight[i] = exponential[candidate_mask[i]];
  const Level level = level_of(gray);
  const float scale = 1.0F / (kUnit * std::max(least_deviation_, level.deviation));
  Lanes sums{}, products{}, learnt_products{};
  for (std::size_t i = 0; i < kPatchArea; i += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const float value = (gray[i + k] - level.mean) * scale;
      const float alike = 1.0F - std::min(1.0F, std::abs(template_[i + k] - value));
      // Eq. (5); exp(min(Mt, Mc)) is the lesser of both exponentials.
      sums[k] += std::min(exponential_[i + k], weight[i + k]) * alike * alike;
      products[k] += template_[i + k] * value;
      learnt_products[k] += learnt_[i + k] * value;
    }
  }
  // The template's deviation is 1 / kUnit, the candidate's at most that.
  constexpr float kNorm = kUnit * kUnit / kPatchArea;
  const float learnt = total(learnt_products);
  const float product = total(products);
  return {static_cast<double>(total(sums)) / greatest_,
          static_cast<double>(kNorm * std::max({product, learnt, -kInverted * learnt})),
          static_cast<double>(kNorm * product), static_cast<double>(level.deviation / deviation_)};
}

}  // namespace ols
