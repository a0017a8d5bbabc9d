// How far the tracker believes that what it follows is the target, 0..1.
#pragma once

namespace ols {

// What one frame says for the target: the best candidate's similarity (eq. (5), 0..1) against what
// the background around it reaches by chance, and how the refined image correlates with the first.
struct FrameEvidence {
  double similarity = 0.0;
  double background_similarity = 0.0;
  double correlation = 0.0;
};

// `typical_correlation` is what the target had of late: something that suddenly looks much less
// like it is something else.
double frame_belief(const FrameEvidence& evidence, double typical_correlation);

// Smoothed over time, so that one poor frame does not lose the target; falls below a half within a
// third of a second without it.
class Belief {
 public:
  void start() { value_ = typical_correlation_ = 1.0; }
  void doubt() { value_ = value_ < kDoubt ? value_ : kDoubt; }
  void update(const FrameEvidence& evidence, double interval_s);
  double value() const { return value_; }

 private:
  static constexpr double kDoubt = 0.2;
  double value_ = 0.0;
  double typical_correlation_ = 1.0;
};

}  // namespace ols
