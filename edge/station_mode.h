// Who has the unit: nobody, the operator, the target that is tracked, the fusion's slews; or a
// stop. Pure.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "edge/ptu/driver.h"
#include "edge/station_types.h"

namespace ols::station {

class StationMode {
 public:
  StationMode();

  StationState state() const { return state_; }
  bool is(StationState state) const { return state_ == state; }
  // False: it is in it already.
  bool enter(StationState state);
  // The states in which a target, where there is one, is tracked.
  bool may_track() const;
  // So much time has passed.
  void count_seconds(double seconds);

  // The emergency stop's level.
  void set_pressed(bool pressed) { pressed_ = pressed; }
  bool is_pressed() const { return pressed_; }
  // For kStopHold_s after it nothing but an emergency's rearming is obeyed.
  static constexpr double kStopHold_s = 1.0;
  void note_stop(double now_s) { stopped_s_ = now_s; }
  // Why the operator is not obeyed now: an emergency, or a stop of a moment ago.
  Refusal refuses_operator(double now_s) const;

  // What the PTU's angles are worth.
  void set_reference(ptu::PtuReference reference) { reference_ = reference; }
  ptu::PtuReference reference() const { return reference_; }
  bool has_doubtful_angles() const;

  const std::map<std::string, double>& counters() const { return counters_; }

 private:
  StationState state_ = StationState::kIdle;
  bool pressed_ = false;
  std::optional<double> stopped_s_;  // by the last stop
  ptu::PtuReference reference_ = ptu::PtuReference::kUnknown;
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
