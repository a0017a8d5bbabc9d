#include "central/fusion/fusion_health.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "central/admission/shared_mount.h"
#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

// Observable: the sigma has fallen to at most this share of that before the first bearing.
constexpr double kSeen = 0.5;

std::map<std::string, double> all_counters(const FusionLog& log, const TrackManager& tracks) {
  auto counters = log.counters;
  const TrackManager::Counts& counts = tracks.counts();
  counters["tracks_born"] = static_cast<double>(counts.initiated);
  counters["tracks_confirmed"] = static_cast<double>(counts.confirmed);
  counters["tracks_dropped"] = static_cast<double>(counts.deleted);
  counters["tracks_merged"] = static_cast<double>(counts.merged);
  counters["bearings_ambiguous"] = static_cast<double>(counts.ambiguous);
  counters["bearings_rejected"] = static_cast<double>(counts.rejected);
  counters["bearings_unexplained"] = static_cast<double>(counts.unexplained);
  return counters;
}

StationBiasReport finding_of(const StationBias& bias) {
  StationBiasReport finding;
  for (int axis = 0; axis < 2; ++axis) {
    const double variance = bias.covariance_rad2(axis, axis);
    if (!(variance < kSeen * kSeen * bias.prior_rad2(axis, axis))) continue;
    finding.bias_rad(axis) = bias.bias_rad(axis);
    finding.bias_sd_rad(axis) = std::sqrt(variance);
    finding.stated_sd_rad(axis) = std::sqrt(bias.prior_rad2(axis, axis));
  }
  if (bias.clock_sd_s < kSeen * bias.clock_prior_sd_s) {
    finding.clock_s = bias.clock_s;
    finding.clock_sd_s = bias.clock_sd_s;
  }
  return finding;
}

struct Findings {
  std::map<std::string, StationBiasReport> by_station;
  std::map<std::string, double> nis;
};

Findings findings_of(const std::vector<Track>& tracks) {
  Findings all;
  for (const Track& track : tracks) {
    if (!is_established(track)) continue;
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

FusionHealth health_of(const Admission& admission, const PointingMonitor& pointing,
                       const UnassociatedMonitor& unassociated, const TrackManager& tracks,
                       const FusionLog& log) {
  FusionHealth health{.now_us = admission.time().now_us(),
                      .stations = {},
                      .counters = all_counters(log, tracks),
                      .alarms = {},
                      .last_error = log.last_error,
                      .cues = {}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Findings findings = findings_of(tracks.tracks());
  for (const auto& [name, station] : admission.stations().all()) {
    const std::int64_t newest = admission.time().newest_us(name);
    StationHealth one;
    one.station = name;
    one.bearings = station.bearings;
    one.rate_hz = station.exposures.rate_hz();
    one.age_s = newest == 0 ? nan : seconds(health.now_us - newest);
    const auto nis = findings.nis.find(name);
    one.residual = nis == findings.nis.end() ? nan : std::sqrt(nis->second / 2.0);
    one.clock_offset_s = admission.clocks().offset_s(name);
    one.quarantine = admission.clocks().quarantine(name);
    if (one.quarantine.empty()) one.quarantine = pointing.quarantine(name);
    const auto found = findings.by_station.find(name);
    if (found != findings.by_station.end()) one.finding = found->second;
    one.calibration = station.traits.calibration;
    const Alarm doubt =
        calibration_alarm(name, one.calibration, {one.finding.bias_rad, one.finding.stated_sd_rad});
    if (!doubt.empty()) health.alarms.push_back(doubt);
    const Alarm alarm =
        one.quarantine.empty() ? unassociated.alarm(name, health.now_us) : one.quarantine;
    if (!alarm.empty()) health.alarms.push_back(alarm);
    health.stations.push_back(std::move(one));
  }
  std::ranges::move(shared_mount_alarms(admission.stations().all()),
                    std::back_inserter(health.alarms));
  return health;
}

}  // namespace ols::fusion
