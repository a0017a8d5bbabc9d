// The cues that are live, of all inputs: what comes in is judged, what is due goes out. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/area.h"
#include "cue/reading.h"

namespace ols::cues {

// What is put in where a source does not say, and what of it is wanted.
struct InputRules {
  std::string name;
  Area area_deg{-90.0, -180.0, 90.0, 180.0};
  double max_age_s = 10.0;
  double horizontal_sd_m = 50.0, vertical_sd_m = 100.0;
  double pressure_height_sd_m = 300.0;  // of a height by pressure above the ellipsoid
  double velocity_sd_m_s = 3.0;         // of a velocity
  double speed_sd_m_s = 15.0;           // of a target of which none is known, each axis
};

// Complete: all of it is finite.
struct LiveCue {
  std::string id, label;
  std::int64_t utime_us = 0;
  double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
  double horizontal_sd_m = 0.0, vertical_sd_m = 0.0;
  std::array<double, 3> velocity_enu_m_s{};
  double velocity_sd_m_s = 0.0;
};

// What came of an input's readings.
struct InputCounts {
  std::int64_t taken = 0;
  std::map<std::string, std::int64_t> refused;  // by reason
  std::string last_refusal;                     // "3c6444: stale"
};

class CueDesk {
 public:
  // `most`: cues at the same time, an equal share of them for each input.
  CueDesk(std::vector<InputRules> inputs, int most);

  void take(std::size_t input, const Readings& readings, std::int64_t now_us);
  // Those that are not too old, each at its own instant.
  std::vector<LiveCue> live(std::int64_t now_us);
  const std::vector<InputCounts>& counts() const { return counts_; }

 private:
  struct Kept {
    LiveCue cue;
    std::size_t input = 0;
    std::int64_t until_us = 0;
  };
  void judge(std::size_t input, const Report& report, std::int64_t now_us);
  // Lets go of what is over, and of what a clock that was set back has left in the future.
  void forget(std::int64_t now_us);
  bool is_full(std::size_t input) const;
  void refuse(std::size_t input, const Refused& refused);

  std::vector<InputRules> inputs_;
  std::vector<InputCounts> counts_;
  std::size_t most_;  // of one input
  std::map<std::string, Kept> kept_;
};

}  // namespace ols::cues
