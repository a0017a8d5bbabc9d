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

// A binomial filter along both axes, the border continued: small changes of the target's shape, and
// half a pixel between the particles, then cost little.
Patch smoothed(const Patch& patch) {
  constexpr std::array<float, 5> kTap{1.0F / 16, 4.0F / 16, 6.0F / 16, 4.0F / 16, 1.0F / 16};
  constexpr std::size_t kRow = kPatchSide + 4;
  Patch across;
  for (std::size_t j = 0; j < kPatchSide; ++j) {
    std::array<float, kRow> row;
    const float* in = &patch[j * kPatchSide];
    std::copy(in, in + kPatchSide, row.begin() + 2);
    row[0] = row[1] = row[2];
    row[kRow - 1] = row[kRow - 2] = row[kRow - 3];
    for (std::size_t i = 0; i < kPatchSide; ++i) {
      across[j * kPatchSide + i] = kTap[0] * (row[i] + row[i + 4]) +
                                   kTap[1] * (row[i + 1] + row[i + 3]) + kTap[2] * row[i + 2];
    }
  }
  Patch both;
  for (std::size_t j = 0; j < kPatchSide; ++j) {
    const auto line = [&](int offset) {
      const int at = std::clamp(static_cast<int>(j) + offset, 0, kPatchSide - 1);
      return &across[static_cast<std::size_t>(at * kPatchSide)];
    };
    const float *a = line(-2), *b = line(-1), *c = line(0), *d = line(1), *e = line(2);
    for (std::size_t i = 0; i < kPatchSide; ++i) {
      both[j * kPatchSide + i] = kTap[0] * (a[i] + e[i]) + kTap[1] * (b[i] + d[i]) + kTap[2] * c[i];
    }
  }
  return both;
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
  constexpr float kLeastGain = 0.15F;
  const Patch gray = smoothed(target.gray);
  const Level level = level_of(gray);
  least_deviation_ = std::max(0.5F * target.noise, kLeastGain * level.deviation);
  deviation_ = std::max(0.5F * target.noise, level.deviation);
  for (std::size_t i = 0; i < kPatchArea; ++i) {
    template_[i] = (gray[i] - level.mean) / (kUnit * deviation_);
  }
}

void Objective::set_mask(const MaskPatch& mask) {
  mask_ = mask;
  greatest_ = 0.0;
  for (const std::uint8_t m : mask_) greatest_ += static_cast<double>(exponentials()[m]);
}

Likeness Objective::operator()(const Patch& gray, const MaskPatch& candidate_mask) const {
  const auto& exponential = exponentials();
  const Patch candidate = smoothed(gray);
  const Level level = level_of(candidate);
  const float scale = 1.0F / (kUnit * std::max(least_deviation_, level.deviation));
  float sum = 0.0F;
  float product = 0.0F;
  for (std::size_t i = 0; i < kPatchArea; ++i) {
    const float value = (candidate[i] - level.mean) * scale;
    const float alike = 1.0F - std::min(1.0F, std::abs(template_[i] - value));
    sum += exponential[std::min(mask_[i], candidate_mask[i])] * alike * alike;
    product += template_[i] * value;
  }
  // The template's deviation is 1 / kUnit, the candidate's at most that.
  const float correlation = product * kUnit * kUnit / kPatchArea;
  return {static_cast<double>(sum) / greatest_, static_cast<double>(correlation),
          static_cast<double>(level.deviation / deviation_)};
}

}  // namespace ols
