// How a station was left, over a restart or a loss of power: whether somebody had taken its leave
// to move, and whether its unit's reference was in doubt. A station that does not know how it was
// left starts stopped, its reference in doubt, and says so in an alarm.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/persisted_word.h"
#include "edge/ptu/driver_types.h"
#include "edge/ptu/reference_doubt.h"
#include "edge/station_types.h"

namespace ols::station {

class PersistedStationState {
 public:
  // Files ID.hold and ID.doubt in `folder`; empty: nothing is remembered, so nothing is known.
  // `has_stop`: the station has an emergency stop. A file that is damaged may have told of one.
  PersistedStationState(const std::string& folder, const std::string& id, bool has_stop);

  // As it shall begin: kIdle, kStopped or kEmergency.
  StationState begin() const { return begin_; }
  // The doubt about the unit's reference that the process before this one left.
  const std::optional<ptu::PtuReferenceDoubt>& doubt() const { return begin_doubt_; }

  // What there is to remember by now; in every turn. `begin()` is unknown no longer once the
  // station has left that state: a person has acted. Does not wait for the disk.
  void remember(StationState state, const std::optional<ptu::PtuReferenceDoubt>& doubt,
                ptu::PtuReference reference);

  // What is not known and what to do; what is not remembered.
  std::vector<std::string> alarms() const;

 private:
  std::string id_;
  PersistedWord hold_, doubt_;
  StationState begin_ = StationState::kStopped;
  std::optional<ptu::PtuReferenceDoubt> begin_doubt_;
  bool hold_unknown_ = false, doubt_unknown_ = false;
};

// Whether an operator, or the emergency stop, has the station in hand: it begins again stopped.
bool is_held(StationState state);

}  // namespace ols::station
