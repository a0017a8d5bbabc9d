#include "central/admission/admission.h"

#include "central/measurement/time_span.h"

namespace ols::fusion {

Admission::Admission(const AdmissionConfig& config)
    : config_(config),
      registry_(config.stations, config.max_stations),
      time_(config.silence_s),
      clocks_(config.clocks) {}

void Admission::evict(const std::string& station, FusionLog& log) {
  log.count("stations_evicted");
  log.error(station, "removed, too many stations");
  time_.forget(station);
  clocks_.forget(station);
}

std::optional<std::string> Admission::know_station(const std::string& station,
                                                   const StationTraits& traits, FusionLog& log) {
  if (!registry_.belongs(station)) return std::nullopt;
  const StationRegistry::Place place = registry_.for_status(station, time_);
  if (place.evicted) evict(*place.evicted, log);
  if (place.station != nullptr) place.station->traits = traits;
  return place.evicted;
}

void Admission::allow_slews(const std::string& station, bool allowed) {
  const auto known = registry_.all().find(station);
  if (known != registry_.all().end()) known->second.traits.commandable = allowed;
}

void Admission::note_target(const BearingMeasurement& measurement, std::int64_t target_id) {
  const auto known = registry_.all().find(measurement.station);
  if (known == registry_.all().end()) return;
  KnownStation& station = known->second;
  const bool sees_another = station.target_id != 0 && station.target_id != target_id &&
                            station.saw_target.within(Activity::kDeliversS, measurement.utime_us);
  if (measurement.is_tracklet && sees_another) return;
  station.target_id = target_id;
  station.saw_target.last_us = measurement.utime_us;
}

Admitted Admission::admit(const BearingMeasurement& measurement, FusionLog& log) {
  const BearingRefusal broken = check(measurement);
  if (broken != BearingRefusal::kNone) return {.refusal = broken};
  if (!registry_.belongs(measurement.station)) return {.refusal = BearingRefusal::kUnknown};
  const auto known = registry_.all().find(measurement.station);
  const bool is_first = known == registry_.all().end() || !known->second.delivered;
  const StationRegistry::Place place = registry_.for_bearing(measurement.station, time_);
  if (place.station == nullptr) return {.refusal = BearingRefusal::kTooMany};
  if (is_first) place.station->set_position(measurement.sight);
  if (place.evicted) evict(*place.evicted, log);
  Admitted admitted{.station = place.station, .evicted = place.evicted};
  admitted.refusal = judge(measurement, *place.station, log);
  const bool is_untimely =
      admitted.refusal == BearingRefusal::kStale || admitted.refusal == BearingRefusal::kFuture;
  place.station->untimely = is_untimely ? place.station->untimely + 1 : 0;
  if (admitted.refusal == BearingRefusal::kNone) notice_changes(measurement, log, admitted);
  return admitted;
}

// Checks the stamp against the station's clock and "now", then against the station's other
// bearings.
BearingRefusal Admission::judge(const BearingMeasurement& measurement, KnownStation& station,
                                FusionLog& log) {
  if (time_.hear(measurement.station, measurement.utime_us)) {
    station.exposures.clear();
    log.count("clock_stepped_back");
    if (clocks_.quarantine(measurement.station).empty()) {
      log.error(measurement.station, "its clock has stepped back");
    }
  }
  if (!clock_is_believed(measurement, log)) {
    station.exposures.clear();
    return BearingRefusal::kQuarantine;
  }
  if (is_future(measurement.utime_us)) return BearingRefusal::kFuture;
  if (seconds(measurement.utime_us - time_.now_us()) < -config_.stale_s) {
    return BearingRefusal::kStale;
  }
  if (measurement.belief < config_.min_belief) return BearingRefusal::kLowBelief;
  return store(measurement, station);
}

bool Admission::is_future(std::int64_t utime_us) const {
  return seconds(utime_us - time_.now_us()) > config_.future_s;
}

bool Admission::clock_is_believed(const BearingMeasurement& measurement, FusionLog& log) {
  const bool before = clocks_.quarantine(measurement.station).empty();
  clocks_.hear(measurement, time_);
  const Alarm& why = clocks_.quarantine(measurement.station);
  time_.trust(measurement.station, why.empty());
  if (before && !why.empty()) log.quarantine(measurement.station, why);
  return why.empty();
}

BearingRefusal Admission::store(const BearingMeasurement& measurement,
                                KnownStation& station) const {
  if (station.exposures.has(measurement)) return BearingRefusal::kDuplicate;
  station.exposures.go_on_to(measurement.utime_us);
  if (station.exposures.is_flood(config_.flood_hz)) return BearingRefusal::kFlood;
  station.exposures.add(measurement);
  station.set_position(measurement.sight);
  return BearingRefusal::kNone;
}

// Detects a new calibration and a new station process, whose track ids start again.
void Admission::notice_changes(const BearingMeasurement& measurement, FusionLog& log,
                               Admitted& admitted) {
  KnownStation& station = *admitted.station;
  if (station.bearings > 0 && station.calibration_id != measurement.calibration_id) {
    admitted.recalibrated = true;
    log.count("calibrations_changed");
  }
  station.calibration_id = measurement.calibration_id;
  if (station.bearings > 0 && station.boot_id != measurement.boot_id) {
    admitted.restarted = true;
    station.target_id = 0;
    log.count("stations_restarted");
  }
  station.boot_id = measurement.boot_id;
  ++station.bearings;
  log.count("bearings");
}

void Admission::begin_time_line() {
  clocks_.clear();
  for (auto& [name, station] : registry_.all()) {
    time_.trust(name, true);
    station.target_id = 0;
  }
}

}  // namespace ols::fusion
