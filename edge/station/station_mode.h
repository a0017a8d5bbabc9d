// The state of a station: what controls its unit (nothing, the operator, the tracked target, the
// fusion's slews, or a stop). Pure.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "edge/mount/reference.h"
#include "edge/station/station_types.h"

namespace ols::station {

class StationMode {
 public:
  StationMode();

  StationState state() const { return state_; }
  bool is(StationState state) const { return state_ == state; }
  // Enters a state. Returns false if the station is already in it.
  bool enter(StationState state);
  // Whether a target, if there is one, is tracked in the present state.
  bool may_track() const;
  // Adds elapsed time to the present state.
  void count_seconds(double seconds);

  // Sets whether the emergency stop is pressed.
  void set_pressed(bool pressed) { pressed_ = pressed; }
  bool is_pressed() const { return pressed_; }
  // After a stop, only re-arming is accepted for this time.
  static constexpr double kStopHold_s = 1.0;
  void note_stop(double now_s) { stopped_s_ = now_s; }
  // Why operators' commands are refused at present: an emergency, or a stop within the last
  // kStopHold_s. kNone if they are accepted.
  Refusal refuses_operator(double now_s) const;

  // Sets whether the PTU's reference is valid.
  void set_reference(mount::Reference reference) { reference_ = reference; }
  mount::Reference reference() const { return reference_; }
  bool has_doubtful_angles() const;

  const std::map<std::string, double>& counters() const { return counters_; }

 private:
  StationState state_ = StationState::kIdle;
  bool pressed_ = false;
  std::optional<double> stopped_s_;  // time of the last stop
  mount::Reference reference_ = mount::Reference::kUnknown;
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
