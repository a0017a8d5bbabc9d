// Judges whether the object that the tracker follows by learnt appearance is still the target. The
// filter's response alone cannot decide this, because a filter that has learnt the wrong object
// finds that object.
#pragma once

#include <optional>

namespace ols::tracker {

// The evidence in one frame in which an object is followed.
struct FollowEvidence {
  // Response::prominence() at the target: the response there minus its mean elsewhere in the
  // window, divided by its standard deviation elsewhere. If the filter has drifted onto the
  // background, it responds everywhere, and this value is low.
  double prominence = 0.0;
  // Result of background_change(); nullopt if there is no image of the background at that place.
  std::optional<double> change = {};
  // LearntAppearance::first_colours() and first_separability().
  double colours = 0.0, separability = 0.0;
};

// The natural logarithm of the odds that the object is the target, from all evidence except
// colours. `own`: the target's prominence during the first half second after the designation.
double follow_log_odds(const FollowEvidence& evidence, double own);
// What the colours add to these log-odds.
double colour_log_odds(const FollowEvidence& evidence);

// The probability, smoothed over time, that the followed object is the target.
class FollowJudge {
 public:
  void start() { *this = {}; }
  void update(const FollowEvidence& evidence, double interval_s);
  // Call when the target is searched for because of long doubt: the time in doubt then counts from
  // zero again.
  void start_search() { doubted_s_ = 0.0; }
  // The natural logarithm of the odds that an object found elsewhere is the target. Colours and
  // earlier frames are not used.
  double log_odds_elsewhere(const FollowEvidence& evidence) const;
  // The probability from response and background, without colours. The tracker acts on this value:
  // it must not drop a target, or search for it, merely because its colours change in a shadow.
  double value() const { return value_; }
  // The probability from response, background and colours, for the published belief.
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
  double doubted_s_ = 0.0;  // duration of the present doubt
  double named_s_ = 0.0;    // time since the designation, counted up to half a second
  double log_own_ = 0.0;    // mean logarithm of the prominence over that time
};

}  // namespace ols::tracker
