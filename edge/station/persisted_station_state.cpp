#include "edge/station/persisted_station_state.h"

#include "conditions/alarms.h"

namespace ols::station {
namespace {

constexpr const char* kFree = "free";
constexpr const char* kStopped = "stopped";
constexpr const char* kUnknown = "unknown";  // and no operator has acted since
constexpr const char* kEmergency = "emergency";

std::string file_of(const std::string& folder, const std::string& id, const char* subject) {
  return folder.empty() ? std::string() : folder + "/" + id + "." + subject;
}

}  // namespace

bool is_held(StationState state) {
  return state == StationState::kEmergency || state == StationState::kStopped ||
         state == StationState::kManual;
}

PersistedStationState::PersistedStationState(const std::string& folder, const std::string& id,
                                             bool has_stop)
    : id_(id),
      hold_(file_of(folder, id, "hold"), {kFree, kStopped, kUnknown, kEmergency}),
      doubt_(file_of(folder, id, "doubt"), mount::doubt_words()) {
  hold_unknown_ = hold_.restore_result() != RestoreResult::kKnown || hold_.word() == kUnknown;
  // A file that is damaged or cannot be written may have recorded an emergency.
  const bool may_be_grave = hold_.restore_result() == RestoreResult::kUnreadable ||
                            hold_.restore_result() == RestoreResult::kUnwritable;
  const bool perhaps_emergency = has_stop && may_be_grave;
  if (hold_.word() == kEmergency || perhaps_emergency) {
    begin_ = StationState::kEmergency;
  } else if (hold_.restore_result() == RestoreResult::kKnown && hold_.word() == kFree) {
    begin_ = StationState::kIdle;
  }
  doubt_unknown_ = doubt_.restore_result() != RestoreResult::kKnown;
  if (doubt_.restore_result() == RestoreResult::kUnreadable) {
    begin_doubt_ = mount::ReferenceDoubt{true, true};
  } else if (doubt_unknown_) {
    begin_doubt_.emplace();
  } else {
    begin_doubt_ = mount::doubt_from_word(doubt_.word());
  }
}

void PersistedStationState::remember(StationState state,
                                     const std::optional<mount::ReferenceDoubt>& doubt,
                                     mount::Reference reference) {
  hold_unknown_ = hold_unknown_ && state == begin_;
  if (state == StationState::kEmergency) {
    // A damaged file is not overwritten until a person has re-armed the station.
    if (!hold_unknown_) hold_.set(kEmergency);
  } else if (is_held(state)) {
    hold_.set(hold_unknown_ ? kUnknown : kStopped);
  } else {
    hold_.set(kFree);
  }
  // Without a unit, the last known doubt stays stored.
  if (doubt) {
    doubt_.set(mount::to_word(doubt));
  } else if (reference == mount::Reference::kTrusted) {
    doubt_.set(mount::to_word(std::nullopt));
    doubt_unknown_ = false;
  }
}

std::vector<Alarm> PersistedStationState::alarms() const {
  std::vector<Alarm> alarms;
  if (hold_unknown_) {
    const std::string why =
        hold_.why_unknown().empty() ? "since an earlier start" : hold_.why_unknown();
    const std::string act = begin_ == StationState::kEmergency
                                ? "check it, then re-arm it"
                                : "check it, then ols-ctl " + id_ + " release";
    alarms.push_back(alarm::stop_state_unknown(why, act));
  }
  if (!hold_.trouble().empty()) alarms.push_back(alarm::stop_state_unsaved(hold_.trouble()));
  if (doubt_unknown_) {
    alarms.push_back(alarm::ptu_reference_unknown(doubt_.why_unknown(), id_));
  }
  if (!doubt_.trouble().empty()) {
    alarms.push_back(alarm::ptu_reference_unsaved(doubt_.trouble()));
  }
  return alarms;
}

}  // namespace ols::station
