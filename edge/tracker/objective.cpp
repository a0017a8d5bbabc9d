#include "edge/tracker/objective.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>

namespace ols::tracker {
namespace {

// Four at a time, each with its own sum: the order is fixed.
using Four = cv::v_float32x4;
constexpr std::size_t kFour = 4;

struct Level {
  float mean;
  float deviation;
};

Level level_of(const Patch& patch) {
  Four sum = cv::v_setzero_f32(), squares = cv::v_setzero_f32();
  for (std::size_t i = 0; i < kPatchArea; i += kFour) {
    const Four value = cv::v_load(&patch[i]);
    sum += value;
    squares += value * value;
  }
  const float mean = cv::v_reduce_sum(sum) / kPatchArea;
  return {mean, std::sqrt(std::max(0.0F, cv::v_reduce_sum(squares) / kPatchArea - mean * mean))};
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
  if (product < 0.0F) {  // inverted: the background has become brighter, or darker, than the target
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
    exponential_[i] = exponentials<float>()[mask[i]];
    greatest_ += static_cast<double>(exponential_[i]);
  }
}

Similarity Objective::operator()(const Patch& gray, const MaskPatch& candidate_mask) const {
  const auto& exponential = exponentials<float>();
  Patch weight;
  for (std::size_t i = 0; i < kPatchArea; ++i) weight[i] = exponential[candidate_mask[i]];
  const Level level = level_of(gray);
  const float scale = 1.0F / (kUnit * std::max(least_deviation_, level.deviation));
  const Four mean = cv::v_setall_f32(level.mean), gain = cv::v_setall_f32(scale);
  const Four one = cv::v_setall_f32(1.0F);
  Four sums = cv::v_setzero_f32(), products = sums, learnt_products = sums;
  for (std::size_t i = 0; i < kPatchArea; i += kFour) {
    const Four value = (cv::v_load(&gray[i]) - mean) * gain;
    const Four first = cv::v_load(&template_[i]);
    const Four alike = one - cv::v_min(one, cv::v_abs(first - value));
    // Eq. (5); exp(min(Mt, Mc)) is the smaller of the two exponentials.
    const Four mask = cv::v_min(cv::v_load(&exponential_[i]), cv::v_load(&weight[i]));
    sums += mask * alike * alike;
    products += first * value;
    learnt_products += cv::v_load(&learnt_[i]) * value;
  }
  // The template's deviation is 1 / kUnit, the candidate's at most that.
  constexpr float kNorm = kUnit * kUnit / kPatchArea;
  const float learnt = cv::v_reduce_sum(learnt_products);
  const float product = cv::v_reduce_sum(products);
  return {static_cast<double>(cv::v_reduce_sum(sums)) / greatest_,
          static_cast<double>(kNorm * std::max({product, learnt, -kInverted * learnt})),
          static_cast<double>(level.deviation / deviation_)};
}

}  // namespace ols::tracker
