// How far the tracker believes that what it follows is the target, 0..1.
#pragma once

namespace ols::tracker {

constexpr double kBelieved = 0.5;  // more is on the target, for what follows from it

// What one frame says for the target: the best candidate's similarity (eq. (5), 0..1) against what
// the background around it reaches by chance, and the candidate's correlation and contrast with the
// target's first image.
struct FrameEvidence {
  double similarity = 0.0;
  double background_similarity = 0.0;
  double correlation = 0.0;
  double contrast = 1.0;
  double standing_out = 1.0;    // of its own surroundings, the target's usual way being 1
  double foreground = 1.0;      // share of the target's foreground that is foreground here,
  bool by_subtraction = false;  // compared with an earlier image of the place, not with a level
};

// What the target had of late: what suddenly looks much less like it is something else.
struct Typical {
  double correlation = 1.0;
  double correlation_variance = 0.0025;
  double contrast = 1.0;
};

double frame_belief(const FrameEvidence& evidence, const Typical& typical);

// Smoothed over time, so that one poor frame does not lose the target; falls below a half within a
// third of a second without it.
class Belief {
 public:
  void start() {
    value_ = of_frame_ = 1.0;
    typical_ = {};
  }
  void doubt() { value_ = value_ < kDoubt ? value_ : kDoubt; }
  void update(const FrameEvidence& evidence, double interval_s);
  double value() const { return value_; }
  // Looks as the target does, by how its look has varied of late: where its place says nothing for
  // it, its look must say more than that it is alike.
  bool usual(const FrameEvidence& evidence) const;
  // What this evidence alone would be believed; the belief stays as it is.
  double in_frame(const FrameEvidence& evidence) const { return frame_belief(evidence, typical_); }
  double of_frame() const { return of_frame_; }  // the newest frame alone

 private:
  static constexpr double kDoubt = 0.2;
  double value_ = 0.0;
  double of_frame_ = 0.0;
  Typical typical_;
};

}  // namespace ols::tracker
