// The tracker's probability, 0..1, that it follows the target.
#pragma once

#include <optional>

namespace ols::tracker {

constexpr double kBelieved = 0.5;  // above this value the tracker counts as being on the target

// The evidence for the best candidate in one frame.
struct FrameEvidence {
  double similarity = 0.0;             // eq. (5), 0..1
  double background_similarity = 0.0;  // similarity that background reaches by chance
  double correlation = 0.0;            // with the target's first or learnt image, -1..1
  double contrast = 1.0;               // relative to that of the target's first image
  // LearntAppearance::recognised(), if the target is followed by its learnt appearance.
  std::optional<double> recognised = {};
  double standing_out = 1.0;  // contrast with its surroundings, relative to the target's usual one
  // Share of the target's foreground that is foreground in this frame, too.
  double foreground = 1.0;
  // The foreground was found by comparison with an earlier image. Otherwise, it was found by
  // comparison with the grey level around the target.
  bool by_subtraction = false;
};

// The target's usual values, averaged over about a second. If the evidence is suddenly far below
// them, the object is another one.
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
  // Whether the evidence is close to the target's usual values. This test is stricter than the
  // belief. It is meant for frames in which the position is no evidence, such as the first one
  // after a cut.
  bool usual(const FrameEvidence& evidence) const;
  // The belief that follows from this evidence alone; the Belief itself does not change.
  double in_frame(const FrameEvidence& evidence) const { return frame_belief(evidence, typical_); }
  // The belief that follows from the newest frame alone.
  double of_frame() const { return of_frame_; }

 private:
  static constexpr double kDoubt = 0.2;
  double value_ = 0.0;
  double of_frame_ = 0.0;
  Typical typical_;
};

}  // namespace ols::tracker
