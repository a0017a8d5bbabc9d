// Judges whether the object followed by its learnt appearance is the target. The filter's response
// alone cannot decide: a filter that has learnt the wrong object finds that object.
#pragma once

#include <optional>

namespace ols::tracker {

// The evidence of one followed frame.
struct FollowEvidence {
  // Response at the target over the deviation of the response elsewhere in the window. A filter
  // that has drifted onto the background responds everywhere.
  double prominence = 0.0;
  // background_change(); nullopt without an image of the background there.
  std::optional<double> change = {};
};

// Natural logarithm of the odds that the object is the target. `own`: the target's prominence when
// it was designated.
double follow_log_odds(const FollowEvidence& evidence, double own);

// The probability over time.
class FollowJudge {
 public:
  void start() { *this = {}; }
  void update(const FollowEvidence& evidence, double interval_s);
  // The object was dropped: the time in doubt restarts at zero for the next one.
  void start_search() { doubted_s_ = 0.0; }
  // The logarithm of the odds that an object found elsewhere is the target, from this evidence
  // alone.
  double log_odds_elsewhere(const FollowEvidence& evidence) const;
  double value() const { return value_; }
  bool sure() const;
  bool believes() const;
  bool doubts() const;
  // Whether there was doubt, and no belief since then: the tracker may follow an object that
  // covered the target.
  bool wary() const { return wary_; }
  // Whether the doubt has lasted so long that the followed object is probably not the target.
  bool lets_go() const;

 private:
  double learn_own(double prominence, double interval_s);

  double value_ = 1.0;
  bool wary_ = false;
  double doubted_s_ = 0.0;  // uninterrupted
  double named_s_ = 0.0;    // time since the designation, up to the limit in use
  double log_own_ = 0.0;    // mean logarithm of the prominence over that time
};

}  // namespace ols::tracker
