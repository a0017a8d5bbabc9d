// The tracker's probability, 0..1, that it follows the target.
#pragma once

#include <optional>

namespace ols::tracker {

constexpr double kBelieved = 0.5;  // above this value the tracker counts as being on the target

// The evidence in one frame: the similarity of the best candidate (eq. (5), 0..1), and the
// similarity that background reaches by chance; the candidate's correlation and contrast with the
// target's first image.
struct FrameEvidence {
  double similarity = 0.0;
  double background_similarity = 0.0;
  double correlation = 0.0;
  double contrast = 1.0;
  // LearntAppearance::recognised(), if the target is followed by its learnt appearance.
  std::optional<double> recognised = {};
  double standing_out = 1.0;  // contrast with its surroundings, relative to the target's usual one
  // Share of the target's foreground that is foreground in this frame, too.
  double foreground = 1.0;
  // Foreground found by comparison with an earlier image, not with a grey level.
  bool by_subtraction = false;
};

// The target's recent values. A sudden, much lower value means that this is another object.
struct Typical {
  double correlation = 1.0;
  double correlation_variance = 0.0025;
  double contrast = 1.0;
};

double frame_belief(const FrameEvidence& evidence, const Typical& typical);

// The belief is smoothed over time, so that one poor frame does not lose the target. If the target
// has gone, the belief falls below 0.5 within a third of a second.
class Belief {
 public:
  void start() {
    value_ = of_frame_ = 1.0;
    typical_ = {};
  }
  void doubt() { value_ = value_ < kDoubt ? value_ : kDoubt; }
  void update(const FrameEvidence& evidence, double interval_s);
  double value() const { return value_; }
  // Whether the evidence is plausible, given the target's recent values. This is stricter than
  // similarity, for a target whose position gives no evidence.
  bool usual(const FrameEvidence& evidence) const;
  // The belief that follows from this evidence alone; the Belief itself does not change.
  double in_frame(const FrameEvidence& evidence) const { return frame_belief(evidence, typical_); }
  double of_frame() const { return of_frame_; }  // from the newest frame alone

 private:
  static constexpr double kDoubt = 0.2;
  double value_ = 0.0;
  double of_frame_ = 0.0;
  Typical typical_;
};

}  // namespace ols::tracker
