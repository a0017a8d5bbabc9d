// The last state of a station, saved over a restart or a power failure: whether the station was
// permitted to move, and whether its PTU's reference was in doubt. If the state is unknown, the
// station starts stopped, with its reference in doubt, and raises an alarm.
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
  // Reads the files ID.hold and ID.doubt in `folder`. If `folder` is empty, nothing is saved, so
  // the state is unknown. `has_stop`: the station has an emergency stop, so a damaged file may have
  // recorded an emergency.
  PersistedStationState(const std::string& folder, const std::string& id, bool has_stop);

  // The state at the start: kIdle, kStopped or kEmergency.
  StationState begin() const { return begin_; }
  // The doubt about the PTU's reference when the previous process ended.
  const std::optional<mount::ReferenceDoubt>& doubt() const { return begin_doubt_; }

  // Call in every turn with the present state, which is then saved. It does not wait for the disk.
  // When the station leaves its first state, a person has acted, so the state is no longer unknown.
  void remember(StationState state, const std::optional<mount::ReferenceDoubt>& doubt,
                mount::Reference reference);

  // Alarms: what is unknown or cannot be saved, and what to do about it.
  std::vector<Alarm> alarms() const;

 private:
  std::string id_;
  PersistedWord hold_, doubt_;
  StationState begin_ = StationState::kStopped;
  std::optional<mount::ReferenceDoubt> begin_doubt_;
  bool hold_unknown_ = false, doubt_unknown_ = false;
};

// Whether the operator or the emergency stop holds the station. If so, the station starts stopped
// next time.
bool is_held(StationState state);

}  // namespace ols::station
