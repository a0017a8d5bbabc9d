// Records whether a station's reference views are checked at all, so that a missing check does not
// look like a good result. Pure.
#pragma once

#include <optional>
#include <string>

#include "conditions/alarm.h"

namespace ols::station {

class CheckRecord {
 public:
  // Call in every turn.
  void note(double now_s);
  void note_judged();
  // Notes a round whose pictures were not recognised: night, fog, another scene.
  void note_unrecognised() { reason_ = "its reference views are not recognised"; }
  // Notes that the round decided nothing, because it left out too many views near the sun.
  void note_sun() { reason_ = "the sun stands in its reference views"; }
  // Notes that the unit did not reach a view in time, in this number of consecutive rounds.
  void note_late(int rounds);
  // Notes that travel limits and keep-out regions leave too few views to decide anything.
  void note_too_few() { too_few_ = true; }

  // The alarm; empty if there is none. A night without a check raises no alarm; a day without a
  // check does.
  Alarm alarm() const;

 private:
  double now_s_ = 0.0;
  std::optional<double> judged_s_;  // time of the last judgement, or of the start
  const char* reason_ = "it was never idle long enough";
  int late_ = 0;
  bool too_few_ = false;
};

}  // namespace ols::station
