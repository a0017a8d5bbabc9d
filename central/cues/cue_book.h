// The fusion's cues: how long each lives, what was allowed of it, which target is where it is.
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

enum class CueState { kWaiting, kSearched, kFound, kForbidden };

struct CueHealth {
  std::string id, label;
  CueState state = CueState::kWaiting;
  std::int64_t target_id = 0;  // the target that is there; 0: none
  double age_s = 0.0;          // since its source knew its place
  Geodetic place;              // now
  double horizontal_sd_m = 0.0, vertical_sd_m = 0.0;
};

class CueBook {
 public:
  explicit CueBook(const CueConfig& config) : config_(config) {}

  // `present_us`: the host's UTC, or of a recording the message's time.
  CueRefusal take(const Cue& cue, std::int64_t present_us, const StationRegistry& stations);
  // Whether there is such a cue, and the configuration leaves it to the operator.
  bool order(const std::string& id, bool allow);
  // Ends what its source has let go of.
  void end_silent(std::int64_t present_us);
  // Which target each cue is, at most at this rate.
  void settle(std::int64_t now_us, const std::vector<Track>& tracks);

  // Those that stations are to be led to: allowed, and no target is there.
  std::vector<CueAim> aims(std::int64_t now_us) const;
  std::vector<CueHealth> health(std::int64_t now_us) const;  // in the order of ids
  bool empty() const { return cues_.empty(); }

 private:
  struct Live {
    Cue cue;
    std::int64_t heard_us = 0;    // by the present
    std::optional<bool> allowed;  // by an operator
    std::int64_t target_id = 0;
  };
  bool is_silent(const Live& live, std::int64_t present_us) const;
  CueState state_of(const Live& live) const;

  CueConfig config_;
  std::map<std::string, Live> cues_;
  std::optional<std::int64_t> settled_us_;
};

}  // namespace ols::fusion
