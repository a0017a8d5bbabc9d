#include "edge/tracker/belief.h"

#include <algorithm>
#include <cmath>

namespace ols {
namespace {

constexpr double kFallTime = 0.12;  // [s]
constexpr double kRiseTime = 0.15;
constexpr double kTypicalTime = 1.0;

double logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

}  // namespace

double frame_belief(const FrameEvidence& evidence, double typical_correlation) {
  const double least = std::clamp(typical_correlation - 0.3, 0.4, 0.65);
  const double room = std::max(0.02, 1.0 - evidence.background_similarity);
  const double above = (evidence.similarity - evidence.background_similarity) / room;
  return logistic(20.0 * (above - 0.12)) * logistic(14.0 * (evidence.correlation - least));
}

void Belief::update(const FrameEvidence& evidence, double interval_s) {
  const double now = frame_belief(evidence, typical_correlation_);
  const double time = now < value_ ? kFallTime : kRiseTime;
  value_ += (now - value_) * (1.0 - std::exp(-interval_s / time));
  value_ = std::clamp(value_, 0.0, 1.0);
  if (value_ >= 0.5) {
    typical_correlation_ += (evidence.correlation - typical_correlation_) *
                            (1.0 - std::exp(-interval_s / kTypicalTime));
  }
}

}  // namespace ols
