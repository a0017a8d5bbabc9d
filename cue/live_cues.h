// The live cues of all inputs. Judges new readings, and keeps the cues that are to be sent. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/config/area.h"
#include "cue/reading.h"

namespace ols::cues {

// For one input: the errors that are assumed if its source states none, and the limits of area and
// age.
struct InputRules {
  std::string name;
  Area area_deg{-90.0, -180.0, 90.0, 180.0};
  double max_age_s = 10.0;
  double horizontal_sd_m = 50.0, vertical_sd_m = 100.0;
  double pressure_height_sd_m = 300.0;  // 1-sigma of a pressure altitude that is used as a height
                                        // above the ellipsoid
  double velocity_sd_m_s = 3.0;         // 1-sigma of a stated velocity whose error is not stated
  double speed_sd_m_s = 15.0;           // 1-sigma of each axis if the source states no velocity,
                                        // which is then taken as 0
};

// A complete cue: all values are finite.
struct LiveCue {
  std::string id, label;
  std::int64_t utime_us = 0;
  double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
  double horizontal_sd_m = 0.0, vertical_sd_m = 0.0;
  std::array<double, 3> velocity_enu_m_s{};
  double velocity_sd_m_s = 0.0;
};

// How many readings of an input were taken or refused.
struct InputCounts {
  std::int64_t taken = 0;
  std::map<std::string, std::int64_t> refused;  // by reason
  std::string last_refusal;                     // "3c6444: stale"
};

class LiveCues {
 public:
  // `most`: the maximum number of cues of all inputs together; each input may have an equal share.
  LiveCues(std::vector<InputRules> inputs, int most);

  void take(std::size_t input, const Readings& readings, std::int64_t now_us);
  // The cues that are not too old, each with the time that its source states.
  std::vector<LiveCue> live(std::int64_t now_us);
  const std::vector<InputCounts>& counts() const { return counts_; }

 private:
  struct Kept {
    LiveCue cue;
    std::size_t input = 0;
    std::int64_t until_us = 0;
  };
  void judge(std::size_t input, const Report& report, std::int64_t now_us);
  // Removes expired cues, and cues whose time is in the future. Cues from the future are left over
  // when the host's clock is set back.
  void forget(std::int64_t now_us);
  bool is_full(std::size_t input) const;
  void refuse(std::size_t input, const Refused& refused);

  std::vector<InputRules> inputs_;
  std::vector<InputCounts> counts_;
  std::size_t most_;  // maximum number of cues of each input
  std::map<std::string, Kept> kept_;
};

}  // namespace ols::cues
