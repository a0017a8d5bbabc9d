// Judges whether the object that is followed by its learnt appearance is the target. The filter's
// response alone cannot tell: a filter that has learnt the wrong object finds that object.
#pragma once

#include <optional>

namespace ols::tracker {

// Of one followed frame.
struct FollowEvidence {
  // Response at the target over the deviation of the response elsewhere in the window. A filter
  // that has drifted onto the background answers everywhere.
  double prominence = 0.0;
  // background_change(); empty without an image that shows the background there.
  std::optional<double> change = {};
};

// Natural logarithm of the odds that it is the target, whose prominence was `own` when it was
// named.
double follow_log_odds(const FollowEvidence& evidence, double own);

// The probability over time.
class FollowJudge {
 public:
  void start() { *this = {}; }
  void update(const FollowEvidence& evidence, double interval_s);
  // The object has been let go: the time in doubt begins at zero for the next one.
  void start_search() { doubted_s_ = 0.0; }
  // The logarithm of the odds that something found elsewhere is the target, by this evidence alone.
  double log_odds_elsewhere(const FollowEvidence& evidence) const;
  double value() const { return value_; }
  bool sure() const;
  bool believes() const;
  bool doubts() const;
  // Has doubted, and not believed since: it may be following an object that covered the target.
  bool wary() const { return wary_; }
  // In doubt for so long that the followed object is hardly the target.
  bool lets_go() const;

 private:
  double learn_own(double prominence, double interval_s);

  double value_ = 1.0;
  bool wary_ = false;
  double doubted_s_ = 0.0;  // without a break
  double named_s_ = 0.0;    // since then, as far as it is looked at
  double log_own_ = 0.0;    // mean of the prominence's logarithm over that time
};

}  // namespace ols::tracker
