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

Admitted Admission::admit(const BearingMeasurement& sighting, FusionLog& log) {
  const BearingRefusal broken = check(sighting);
  if (broken != BearingRefusal::kNone) return {.refusal = broken};
  if (!registry_.belongs(sighting.station)) return {.refusal = BearingRefusal::kUnknown};
  const auto known = registry_.all().find(sighting.station);
  const bool is_first = known == registry_.all().end() || !known->second.delivered;
  const StationRegistry::Place place = registry_.for_bearing(sighting.station, time_);
  if (place.station == nullptr) return {.refusal = BearingRefusal::kTooMany};
  if (is_first) place.station->set_position(sighting.sight);
  if (place.evicted) evict(*place.evicted, log);
  Admitted admitted{.station = place.station, .evicted = place.evicted};
  admitted.refusal = judge(sighting, *place.station, log);
  if (admitted.refusal == BearingRefusal::kNone) notice_changes(sighting, log, admitted);
  return admitted;
}

// Checks the stamp against the station's clock and "now", then against the station's other
// bearings.
BearingRefusal Admission::judge(const BearingMeasurement& sighting, KnownStation& station,
                                FusionLog& log) {
  if (time_.hear(sighting.station, sighting.utime_us)) {
    station.exposures.clear();
    log.count("clock_stepped_back");
    if (clocks_.quarantine(sighting.station).empty()) {
      log.error(sighting.station, "its clock has stepped back");
    }
  }
  if (!clock_is_believed(sighting, log)) {
    station.exposures.clear();
    return BearingRefusal::kQuarantine;
  }
  if (is_future(sighting.utime_us)) return BearingRefusal::kFuture;
  if (seconds(sighting.utime_us - time_.now_us()) < -config_.stale_s) {
    return BearingRefusal::kStale;
  }
  if (sighting.belief < config_.min_belief) return BearingRefusal::kLowBelief;
  return store(sighting, station);
}

bool Admission::is_future(std::int64_t utime_us) const {
  return seconds(utime_us - time_.now_us()) > config_.future_s;
}

bool Admission::clock_is_believed(const BearingMeasurement& sighting, FusionLog& log) {
  const bool before = clocks_.quarantine(sighting.station).empty();
  clocks_.hear(sighting, time_);
  const std::string& why = clocks_.quarantine(sighting.station);
  time_.trust(sighting.station, why.empty());
  if (before && !why.empty()) log.quarantine(sighting.station, why);
  return why.empty();
}

BearingRefusal Admission::store(const BearingMeasurement& sighting, KnownStation& station) const {
  if (station.exposures.has(sighting)) return BearingRefusal::kDuplicate;
  station.exposures.go_on_to(sighting.utime_us);
  if (station.exposures.is_flood(config_.flood_hz)) return BearingRefusal::kFlood;
  station.exposures.add(sighting);
  station.set_position(sighting.sight);
  return BearingRefusal::kNone;
}

// Detects a new calibration and a new station process, whose track ids start again.
void Admission::notice_changes(const BearingMeasurement& sighting, FusionLog& log,
                               Admitted& admitted) {
  KnownStation& station = *admitted.station;
  if (station.bearings > 0 && station.calibration_id != sighting.calibration_id) {
    admitted.recalibrated = true;
    log.count("calibrations_changed");
  }
  station.calibration_id = sighting.calibration_id;
  if (station.bearings > 0 && station.boot_id != sighting.boot_id) {
    admitted.restarted = true;
    station.target_id = 0;
    log.count("stations_restarted");
  }
  station.boot_id = sighting.boot_id;
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
