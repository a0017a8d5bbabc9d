// Whether a station's reference views are checked at all: silence must not look like quiet. Pure.
#pragma once

#include <optional>
#include <string>

namespace ols::station {

class CheckRecord {
 public:
  // In every turn.
  void note(double now_s);
  void note_judged();
  // A round whose pictures said nothing: night, fog, another scene.
  void note_unrecognised() { reason_ = "its reference views are not recognised"; }
  // So many views were left out because of the sun that nothing could be told.
  void note_sun() { reason_ = "the sun stands in its reference views"; }
  // The unit did not come to a view in time, in so many rounds in a row.
  void note_late(int rounds);
  // The travel and the keep-out regions leave so many views that nothing can be told.
  void note_too_few() { too_few_ = true; }

  // What to say; empty: nothing. A night is no reason to say anything, a day is.
  std::string alarm() const;

 private:
  double now_s_ = 0.0;
  std::optional<double> judged_s_;  // or the beginning
  const char* reason_ = "it was never idle long enough";
  int late_ = 0;
  bool too_few_ = false;
};

}  // namespace ols::station
