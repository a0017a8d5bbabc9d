// Records whether a station's reference views are checked at all. Without this record, a missing
// check would look like a good result. Pure.
#pragma once

#include <optional>
#include <string>

#include "conditions/alarm.h"

namespace ols::station {

class CheckRecord {
 public:
  // Call in every cycle of the control loop.
  void note(double now_s);
  // Notes that a round of checks has given a result.
  void note_judged();
  // Notes that a round gave no result, because its pictures were not recognised: night, fog,
  // another scene.
  void note_unrecognised() { reason_ = "its reference views are not recognised"; }
  // Notes that a round gave no result, because it left out too many views near the sun.
  void note_sun() { reason_ = "the sun stands in its reference views"; }
  // Notes the number of consecutive rounds in which the unit did not reach a view in time.
  void note_late(int rounds);
  // Notes that travel limits and keep-out regions leave too few views for a check.
  void note_too_few() { too_few_ = true; }

  // The alarm that checks are missing: no result for 24 hours, three late rounds, or too few views.
  // Empty otherwise; a night without a check raises no alarm.
  Alarm alarm() const;

 private:
  double now_s_ = 0.0;
  // Time of the last result or, before the first one, of the start.
  std::optional<double> judged_s_;
  const char* reason_ = "it was never idle long enough";
  int late_ = 0;
  bool too_few_ = false;
};

}  // namespace ols::station
