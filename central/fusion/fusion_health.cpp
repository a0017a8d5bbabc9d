// What the fusion tells of itself.
#include <cmath>
#include <limits>

#include "central/fusion/fusion.h"
#include "central/measurement/time_span.h"

namespace ols {

std::map<std::string, double> Fusion::counters() const {
  auto counters = counters_;
  const TrackKeeper::Counts& counts = keeper_.counts();
  counters["tracks_born"] = static_cast<double>(counts.born);
  counters["tracks_confirmed"] = static_cast<double>(counts.confirmed);
  counters["tracks_dropped"] = static_cast<double>(counts.dropped);
  counters["tracks_merged"] = static_cast<double>(counts.merged);
  counters["bearings_ambiguous"] = static_cast<double>(counts.ambiguous);
  counters["bearings_set_aside"] = static_cast<double>(counts.set_aside);
  counters["bearings_unexplained"] = static_cast<double>(counts.unexplained);
  return counters;
}

namespace {

// Seen by the geometry: known twice as well as before the first bearing.
constexpr double kSeen = 0.5;

StationFinding finding_of(const StationBias& bias) {
  StationFinding finding;
  for (int axis = 0; axis < 2; ++axis) {
    const double variance = bias.covariance_rad2(axis, axis);
    if (!(variance < kSeen * kSeen * bias.prior_rad2(axis, axis))) continue;
    finding.bias_rad(axis) = bias.bias_rad(axis);
    finding.bias_sd_rad(axis) = std::sqrt(variance);
  }
  if (bias.clock_sd_s < kSeen * bias.clock_prior_sd_s) {
    finding.clock_s = bias.clock_s;
    finding.clock_sd_s = bias.clock_sd_s;
  }
  return finding;
}

struct Findings {
  std::map<std::string, StationFinding> by_station;
  std::map<std::string, double> nis;
};

Findings findings_of(const std::vector<Track>& tracks) {
  Findings all;
  for (const Track& track : tracks) {
    if (!is_sure(track)) continue;
    const auto& stations = track.filter.stations();
    for (std::size_t i = 0; i < stations.size(); ++i) {
      if (stations[i].last_used.last_us == 0) continue;
      all.by_station.try_emplace(stations[i].station, finding_of(track.filter.bias(i)));
      all.nis.try_emplace(stations[i].station, stations[i].mean_nis);
    }
  }
  return all;
}

}  // namespace

FusionHealth Fusion::health() const {
  FusionHealth health{.now_us = now_us(),
                      .stations = {},
                      .counters = counters(),
                      .alarms = {},
                      .last_error = last_error_};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Findings findings = findings_of(keeper_.tracks());
  for (const auto& [name, station] : stations_) {
    const std::int64_t newest = time_.newest_us(name);
    StationHealth one;
    one.station = name;
    one.bearings = station.bearings;
    one.rate_hz = station.rate_hz;
    one.age_s = newest == 0 ? nan : seconds(health.now_us - newest);
    const auto nis = findings.nis.find(name);
    one.residual = nis == findings.nis.end() ? nan : std::sqrt(nis->second / 2.0);
    one.clock_offset_s = clocks_.offset_s(name);
    one.quarantine = clocks_.quarantine(name);
    if (one.quarantine.empty()) one.quarantine = pointing_.quarantine(name);
    const auto found = findings.by_station.find(name);
    if (found != findings.by_station.end()) one.finding = found->second;
    const std::string alarm = one.quarantine.empty()
                                  ? strays_.alarm(name, health.now_us)
                                  : "station " + name + ": not used, " + one.quarantine;
    if (!alarm.empty()) health.alarms.push_back(alarm);
    health.stations.push_back(std::move(one));
  }
  return health;
}

}  // namespace ols
