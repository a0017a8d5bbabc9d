// Saves the state of a station, so that it survives a restart or a power failure: whether the
// station was permitted to move, and whether its PTU's reference was in doubt. If the saved state
// is unknown, the station starts stopped, with its reference in doubt, and raises an alarm.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/files/persisted_word.h"
#include "conditions/alarm.h"
#include "edge/mount/reference.h"
#include "edge/station/station_types.h"

namespace ols::station {

class PersistedStationState {
 public:
  // Reads the files ID.hold and ID.doubt in `folder`. If `folder` is empty, nothing is saved, and
  // the state is unknown. `has_stop`: whether the station has an emergency stop. If it has one and
  // ID.hold is damaged, this file may have recorded an emergency; the station then starts in
  // kEmergency.
  PersistedStationState(const std::string& folder, const std::string& id, bool has_stop);

  // The state at the start: kIdle, kStopped or kEmergency.
  StationState begin() const { return begin_; }
  // The doubt about the PTU's reference when the previous process ended; nullopt if there was none.
  const std::optional<mount::ReferenceDoubt>& doubt() const { return begin_doubt_; }

  // Saves the present state, without waiting for the disk. Call it in every cycle of the control
  // loop. When the station leaves its first state, a person has acted; from then on, the state is
  // no longer unknown.
  void remember(StationState state, const std::optional<mount::ReferenceDoubt>& doubt,
                mount::Reference reference);

  // The alarms say what is unknown or cannot be saved, and what to do about it.
  std::vector<Alarm> alarms() const;

 private:
  std::string id_;
  PersistedWord hold_, doubt_;
  StationState begin_ = StationState::kStopped;
  std::optional<mount::ReferenceDoubt> begin_doubt_;
  bool hold_unknown_ = false, doubt_unknown_ = false;
};

// Whether the operator or the emergency stop holds the station in this state. If so, its next start
// begins in kStopped or kEmergency.
bool is_held(StationState state);

}  // namespace ols::station
