#include "edge/tracker/belief.h"

#include <algorithm>
#include <cmath>

namespace ols {
namespace {

constexpr double kFallTime = 0.12;  // [s]
constexpr double kRiseTime = 0.15;

double logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

}  // namespace

double frame_belief(const FrameEvidence& evidence) {
  const double room = std::max(0.02, 1.0 - evidence.background_similarity);
  const double above = (evidence.similarity - evidence.background_similarity) / room;
  return logistic(16.0 * (above - 0.35)) * logistic(16.0 * (evidence.correlation - 0.4));
}

void Belief::update(const FrameEvidence& evidence, double interval_s) {
  const double now = frame_belief(evidence);
  const double time = now < value_ ? kFallTime : kRiseTime;
  value_ += (now - value_) * (1.0 - std::exp(-interval_s / time));
  value_ = std::clamp(value_, 0.0, 1.0);
}

}  // namespace ols
