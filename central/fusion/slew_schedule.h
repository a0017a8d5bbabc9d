// The rounds of slews: each station's, some with each bearing, so that no bearing waits for long
// behind a thousand stations' slews. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "central/admission/station_registry.h"
#include "central/fusion/bearing_lines.h"
#include "central/fusion/slew_planner.h"

namespace ols::fusion {

class SlewSchedule {
 public:
  // give_up_s: a round that was not ended for so long is given up.
  SlewSchedule(const SlewConfig& config, double give_up_s)
      : config_(config), give_up_s_(give_up_s), planner_(config) {}

  // Those that are made with one bearing, at the instant "now".
  std::vector<Slew> plan(std::int64_t now_us, const StationRegistry& stations,
                         const BearingLines& lines, const std::vector<Track>& tracks);
  void forget(const std::string& station) { planner_.forget(station); }
  void clear() { *this = SlewSchedule(config_, give_up_s_); }

 private:
  void begin(std::int64_t now_us, const StationRegistry& stations, const BearingLines& lines);

  SlewConfig config_;
  double give_up_s_;
  SlewPlanner planner_;
  SlewRound round_;
  std::optional<std::int64_t> begun_us_;  // the last round
  std::optional<std::string> next_;       // the station that is next in it; nothing: it is over
};

}  // namespace ols::fusion
