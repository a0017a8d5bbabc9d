// The last state of a station, which survives a restart or a power failure: whether the station was
// permitted to move, and whether its PTU's reference was in doubt. A station whose state is unknown
// starts stopped, with its reference in doubt, and raises an alarm.
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
  // Files ID.hold and ID.doubt in `folder`. Empty: nothing is saved, so the state is unknown.
  // `has_stop`: the station has an emergency stop; a damaged file may have recorded one.
  PersistedStationState(const std::string& folder, const std::string& id, bool has_stop);

  // The state at the start: kIdle, kStopped or kEmergency.
  StationState begin() const { return begin_; }
  // The doubt about the PTU's reference at the end of the previous process.
  const std::optional<mount::ReferenceDoubt>& doubt() const { return begin_doubt_; }

  // Call in every turn with the present state, to be saved. Does not wait for the disk. Once the
  // station has left its first state, a person has acted, and the state is no longer unknown.
  void remember(StationState state, const std::optional<mount::ReferenceDoubt>& doubt,
                mount::Reference reference);

  // Alarms: what is unknown or cannot be saved, and what to do.
  std::vector<Alarm> alarms() const;

 private:
  std::string id_;
  PersistedWord hold_, doubt_;
  StationState begin_ = StationState::kStopped;
  std::optional<mount::ReferenceDoubt> begin_doubt_;
  bool hold_unknown_ = false, doubt_unknown_ = false;
};

// Whether the operator or the emergency stop holds the station. If so, it starts stopped next time.
bool is_held(StationState state);

}  // namespace ols::station
