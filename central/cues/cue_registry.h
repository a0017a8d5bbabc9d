// All current cues: the age of each, the operator's decision on it, and the target found there.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "central/cues/cue_check.h"
#include "central/tracking/track.h"

namespace ols::fusion {

// The values are those of fusion_status_t.
enum class CueState { kWaiting, kSearched, kFound, kForbidden };

struct CueHealth {
  std::string id, label;
  CueState state = CueState::kWaiting;
  std::int64_t target_id = 0;  // the target found there; 0 if none
  double age_s = 0.0;          // time since the source measured the position
  Geodetic place;              // position now
  double horizontal_sd_m = 0.0, vertical_sd_m = 0.0;
};

// Whether the target is at the cue's position: their difference is within the 99.9 % region of both
// uncertainties together.
bool is_there(const CueAim& aim, const Track& track, std::int64_t now_us);

// The report on one cue. target_id: the target found there; 0 if none.
CueHealth health_of(const CueAim& aim, CueState state, std::int64_t target_id, std::int64_t now_us);

class CueRegistry {
 public:
  explicit CueRegistry(const CueConfig& config) : config_(config) {}

  // present_us: the host's UTC; in a replay, the message's time.
  CueRefusal take(const Cue& cue, std::int64_t present_us, const StationRegistry& stations);
  // Takes an operator's decision. Returns false if there is no such cue, or if the configuration
  // leaves no decision to operators.
  bool order(const std::string& id, bool allow);
  // Removes cues that their sources no longer send.
  void end_silent(std::int64_t present_us);
  // Finds the target at each cue. Does nothing within a short time of its last call.
  void settle(std::int64_t now_us, const std::vector<Track>& tracks);

  // The cues to which stations are to be led: those that are allowed and have no target yet.
  std::vector<CueAim> aims(std::int64_t now_us) const;
  std::vector<CueHealth> health(std::int64_t now_us) const;  // sorted by id
  bool empty() const { return cues_.empty(); }

 private:
  struct Live {
    Cue cue;
    // When the cue was last received, on the clock of `present_us`.
    std::int64_t heard_us = 0;
    std::optional<bool> allowed;  // the operator's decision
    std::int64_t target_id = 0;
  };
  bool is_silent(const Live& live, std::int64_t present_us) const;
  CueState state_of(const Live& live) const;

  CueConfig config_;
  std::map<std::string, Live> cues_;
  std::optional<std::int64_t> settled_us_;
};

}  // namespace ols::fusion
