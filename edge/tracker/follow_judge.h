// Judges whether the object that is followed by its learnt appearance is still the target. The
// filter's response alone cannot decide this, because a filter that has learnt the wrong object
// finds that object.
#pragma once

#include <optional>

namespace ols::tracker {

// The evidence in one frame in which an object is followed.
struct FollowEvidence {
  // Response at the target, relative to the deviation of the response elsewhere in the window. If
  // the filter has drifted onto the background, it responds everywhere.
  double prominence = 0.0;
  // Result of background_change(); nullopt if there is no image of the background at that place.
  std::optional<double> change = {};
  // LearntAppearance::first_colours() and first_separability().
  double colours = 0.0, separability = 0.0;
};

// The natural logarithm of the odds that the object is the target, without its colours. `own`: the
// target's prominence when it was designated.
double follow_log_odds(const FollowEvidence& evidence, double own);
// What the colours add to these log-odds.
double colour_log_odds(const FollowEvidence& evidence);

// The probability, smoothed over time, that the followed object is the target.
class FollowJudge {
 public:
  void start() { *this = {}; }
  void update(const FollowEvidence& evidence, double interval_s);
  // Call when the object was dropped: the time in doubt restarts at zero for the next object.
  void start_search() { doubted_s_ = 0.0; }
  // The logarithm of the odds that an object found elsewhere is the target, from this evidence
  // alone.
  double log_odds_elsewhere(const FollowEvidence& evidence) const;
  // The probability from the response and the background. It decides what the tracker does. It
  // leaves the colours out, because a target whose colours change in a shadow must be neither
  // dropped nor searched for.
  double value() const { return value_; }
  // The same with the colours, for the published belief.
  double belief() const { return belief_; }
  bool sure() const;
  bool believes() const;
  bool doubts() const;
  // True from the moment of doubt until the target is believed again. Meanwhile the tracker may be
  // following an object that covered the target.
  bool wary() const { return wary_; }
  // Whether the doubt has lasted so long that the followed object is probably not the target.
  bool lets_go() const;

 private:
  double learn_own(double prominence, double interval_s);

  double value_ = 1.0, belief_ = 1.0;
  bool wary_ = false;
  double doubted_s_ = 0.0;  // time in doubt without interruption
  double named_s_ = 0.0;    // time since the designation, up to the limit that is used
  double log_own_ = 0.0;    // mean logarithm of the prominence over that time
};

}  // namespace ols::tracker
