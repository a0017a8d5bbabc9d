// The tracker's probability, 0..1, that it follows the target.
#pragma once

#include <optional>

namespace ols::tracker {

constexpr double kBelieved = 0.5;  // above it the tracker counts as on target

// The evidence of one frame: the best candidate's similarity (eq. (5), 0..1), compared with what
// the background reaches by chance; its correlation and contrast with the target's first image.
struct FrameEvidence {
  double similarity = 0.0;
  double background_similarity = 0.0;
  double correlation = 0.0;
  double contrast = 1.0;
  // LearntAppearance::recognised(), if the target is followed by it.
  std::optional<double> recognised = {};
  double standing_out = 1.0;  // contrast with its surroundings, relative to the target's usual one
  double foreground = 1.0;    // share of the target's foreground that is foreground here too,
  bool by_subtraction = false;  // compared with an earlier image, not with a grey level
};

// The target's recent values. A sudden, much lower value means another object.
struct Typical {
  double correlation = 1.0;
  double correlation_variance = 0.0025;
  double contrast = 1.0;
};

double frame_belief(const FrameEvidence& evidence, const Typical& typical);

// Smoothed over time, so that one poor frame does not lose the target. Without the target it falls
// below 0.5 within a third of a second.
class Belief {
 public:
  void start() {
    value_ = of_frame_ = 1.0;
    typical_ = {};
  }
  void doubt() { value_ = value_ < kDoubt ? value_ : kDoubt; }
  void update(const FrameEvidence& evidence, double interval_s);
  double value() const { return value_; }
  // Whether the target's recent values make this evidence plausible. Stricter than similarity. For
  // a target whose position is no evidence.
  bool usual(const FrameEvidence& evidence) const;
  // The belief from this evidence alone; does not change the belief.
  double in_frame(const FrameEvidence& evidence) const { return frame_belief(evidence, typical_); }
  double of_frame() const { return of_frame_; }  // the newest frame alone

 private:
  static constexpr double kDoubt = 0.2;
  double value_ = 0.0;
  double of_frame_ = 0.0;
  Typical typical_;
};

}  // namespace ols::tracker
