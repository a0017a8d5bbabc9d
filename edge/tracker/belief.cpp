#include "edge/tracker/belief.h"

#include <algorithm>
#include <cmath>

namespace ols::tracker {
namespace {

constexpr double kFallTime = 0.12;  // [s]
constexpr double kRiseTime = 0.15;
constexpr double kTypicalTime = 1.0;
constexpr double kSimilarityShare = 0.2;
constexpr double kLeastRecognised = 0.4;
constexpr double kMostContrastRatio = 0.8;  // natural logarithm of the ratio

double logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

}  // namespace

double frame_belief(const FrameEvidence& evidence, const Typical& typical) {
  const double least = std::clamp(typical.correlation - 0.3, 0.4, 0.65);
  const double room = std::max(0.02, 1.0 - evidence.background_similarity);
  const double above =
      std::clamp((evidence.similarity - evidence.background_similarity) / room, -0.5, 0.5);
  const double contrast =
      std::abs(std::log(std::max(evidence.contrast, 1e-3) / std::max(typical.contrast, 1e-3)));
  const double out = std::clamp(evidence.standing_out, 0.0, 1.0);
  const double fore = evidence.by_subtraction ? logistic(14.0 * (evidence.foreground - 0.3)) : 1.0;
  const double by_template =
      14.0 * (evidence.correlation + kSimilarityShare * above + 0.3 * (out - 0.5) - least);
  // What the filter has learnt to recognise need not look like the first image.
  if (evidence.recognised) {
    return logistic(12.0 * (*evidence.recognised - kLeastRecognised) +
                    std::clamp(by_template, -1.0, 1.0));
  }
  return logistic(by_template) * logistic(8.0 * (kMostContrastRatio - contrast)) * fore;
}

bool Belief::usual(const FrameEvidence& evidence) const {
  const double below = typical_.correlation - evidence.correlation;
  const double sd = std::sqrt(typical_.correlation_variance);
  const double ratio =
      std::log(std::max(evidence.contrast, 1e-3) / std::max(typical_.contrast, 1e-3));
  return below < 2.0 * sd && evidence.standing_out > 0.5 && std::abs(ratio) < kMostContrastRatio;
}

void Belief::update(const FrameEvidence& evidence, double interval_s) {
  of_frame_ = frame_belief(evidence, typical_);
  const double time = of_frame_ < value_ ? kFallTime : kRiseTime;
  value_ += (of_frame_ - value_) * (1.0 - std::exp(-interval_s / time));
  value_ = std::clamp(value_, 0.0, 1.0);
  if (value_ >= 0.5) {
    const double share = 1.0 - std::exp(-interval_s / kTypicalTime);
    const double off = evidence.correlation - typical_.correlation;
    typical_.correlation += share * off;
    typical_.correlation_variance += share * (off * off - typical_.correlation_variance);
    typical_.contrast += share * (evidence.contrast - typical_.contrast);
  }
}

}  // namespace ols::tracker
