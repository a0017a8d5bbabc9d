#include "edge/station/station_mode.h"

namespace ols::station {

StationMode::StationMode() {
  for (int i = 0; i <= static_cast<int>(StationState::kHidden); ++i) {
    counters_[std::string("seconds_") + to_string(static_cast<StationState>(i))] = 0.0;
  }
}

bool StationMode::enter(StationState state) {
  if (state == state_) return false;
  state_ = state;
  counters_[std::string("entered_") + to_string(state)] += 1;
  return true;
}

bool StationMode::may_track() const {
  return state_ != StationState::kIdle && state_ != StationState::kManual &&
         state_ != StationState::kStopped && state_ != StationState::kEmergency;
}

void StationMode::count_seconds(double seconds) {
  counters_[std::string("seconds_") + to_string(state_)] += seconds;
}

Refusal StationMode::refuses_operator(double now_s) const {
  if (state_ == StationState::kEmergency) return Refusal::kEmergency;
  const bool holds =
      state_ == StationState::kStopped && stopped_s_ && now_s - *stopped_s_ < kStopHold_s;
  return holds ? Refusal::kJustStopped : Refusal::kNone;
}

bool StationMode::has_doubtful_angles() const {
  return reference_ == mount::Reference::kMissing || reference_ == mount::Reference::kDoubted;
}

}  // namespace ols::station
