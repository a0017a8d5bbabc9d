#include "central/fusion/slew_schedule.h"

#include "central/fusion/output_period.h"
#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

constexpr int kStationsABearing = 16;

}  // namespace

void SlewSchedule::begin(std::int64_t now_us, const StationRegistry& stations,
                         const BearingLines& lines) {
  begun_us_ = now_us;
  next_ = "";
  round_ = {.now_us = now_us};
  for (const auto& [name, station] : stations.all()) {
    const std::int64_t target = station.follows(now_us);
    if (target != 0) ++round_.seen_by[target];
  }
  for (const std::string& station : lines.stations(now_us)) {
    const auto own = lines.of(station, now_us);
    if (own.empty()) continue;  // many detections, not an object that it follows
    round_.bearing_only_stations.insert(station);
    if (round_.ray) continue;
    const auto line = lines.at(*own.front(), now_us);
    if (!line) continue;
    round_.ray = CueRay{station, line->sight.origin_ecef, direction_ecef(line->sight)};
  }
}

std::vector<Slew> SlewSchedule::plan(std::int64_t now_us, const StationRegistry& stations,
                                     const BearingLines& lines, const std::vector<Track>& tracks) {
  if (next_ && seconds(now_us - *begun_us_) > give_up_s_) next_.reset();
  if (!next_ && is_due(begun_us_, now_us, config_.rate_hz)) begin(now_us, stations, lines);
  if (!next_) return {};
  round_.now_us = now_us;  // a round may take a while; each slew is for the time of its creation
  std::vector<SlewStation> some;
  auto station = stations.all().lower_bound(*next_);
  for (; station != stations.all().end() && some.size() < kStationsABearing; ++station) {
    some.push_back({station->first, station->second.traits, station->second.follows(now_us)});
  }
  next_.reset();
  if (station != stations.all().end()) next_ = station->first;
  return planner_.plan(round_, some, tracks);
}

}  // namespace ols::fusion
