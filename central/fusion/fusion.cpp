#include "central/fusion/fusion.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "central/fusion/track_intake.h"
#include "central/ground/station_on_land.h"
#include "central/measurement/time_span.h"
#include "conditions/alarms.h"
#include "conditions/refusal.h"
#include "geometry/angles.h"
#include "wire/cue_values.h"

namespace ols::fusion {
namespace {

constexpr double kStepBackS = 1.0;  // a larger step back of "now" resets message time

TargetScheduleConfig schedule_of(const FusionConfig& config) {
  return {.estimator = config.estimator,
          .rate_hz = config.rate_hz,
          .paper_targets = config.paper_targets,
          .give_up_s = config.tracks.drop_s,
          .estimators = config.estimators,
          .land = config.land};
}

TrackManagerConfig tracks_of(const FusionConfig& config) {
  TrackManagerConfig tracks = config.tracks;
  tracks.initiation.land = config.land.surface;
  return tracks;
}

}  // namespace

Fusion::Fusion(const FusionConfig& config)
    : config_(config),
      admission_(config.admission),
      pointing_(config.pointing),
      unassociated_(config.unassociated),
      tracks_(tracks_of(config)),
      targets_(schedule_of(config)),
      slews_(config.slew, config.tracks.drop_s, config.handover.staring),
      occlusions_(config.land.surface),
      cues_(config.cues),
      handover_(config.handover) {
  if (!make_estimator(config.estimator, config.estimators)) {
    throw std::invalid_argument("unknown estimator " + config.estimator);
  }
  for (const char* name : {"bearings", "targets", "targets_without_position", "slews",
                           "clock_stepped_back", "time_stepped_back", "stations_evicted",
                           "stations_quarantined", "calibrations_changed", "stations_restarted",
                           "paper_targets_thinned", "cues", "cue_orders", "cue_orders_refused"}) {
    log_.counters[name] = 0.0;
  }
  for (int i = 1; i < static_cast<int>(BearingRefusal::kCount); ++i) {
    log_.counters[to_string(static_cast<BearingRefusal>(i))] = 0.0;
  }
  for (int i = 1; i < static_cast<int>(CueRefusal::kCount); ++i) {
    log_.counters[to_string(static_cast<CueRefusal>(i))] = 0.0;
  }
}

void Fusion::know_station(const std::string& station, const StationTraits& traits) {
  const auto evicted = admission_.know_station(station, traits, log_);
  if (evicted) forget(*evicted);
  if (traits.axis) tracks_.know_view(station, *traits.axis, traits.field_of_view_rad, now_us());
}

void Fusion::know_skyline(const SkylineSector& sector) {
  if (admission_.stations().all().contains(sector.station)) tracks_.know_skyline(sector);
}

void Fusion::allow_slews(const std::string& station, bool allowed) {
  admission_.allow_slews(station, allowed);
}

FusionOutput Fusion::add(const BearingMeasurement& measurement) {
  FusionOutput output;
  const Admitted admitted = admission_.admit(measurement, log_);
  forget_what_changed(measurement, admitted);
  output.refusal = admitted.refusal;
  std::vector<ImageBearings> used;
  if (output.refusal == BearingRefusal::kNone) output.refusal = take(measurement, used);
  note_refusal(output.refusal, measurement, admitted);
  const std::int64_t now = now_us();
  // After a silence, "now" stays old until most stations have sent again. Nothing is published for
  // such a time.
  if (now == 0 || admission_.is_future(measurement.utime_us)) return output;
  if (targets_.epoch_us() && seconds(*targets_.epoch_us() - now) > kStepBackS) begin_time_line();
  for (const ImageBearings& image : used) targets_.hear(image.front(), now);
  targets_.tell(now, tracks_, admission_.clocks(), pointing_, output, log_);
  output.slews = slews_at(now);
  output.occlusions = occlusions_.plan(now, output.slews, admission_.stations(), tracks_.tracks(),
                                       tracks_.skylines(), tracks_.losses());
  return output;
}

std::vector<Slew> Fusion::slews_at(std::int64_t now_us) {
  if (!cues_.empty()) cues_.settle(now_us, tracks_.tracks());
  handover_.settle(now_us, tracks_.tracks());
  const bool with_tracklets = handover_.leads_by_itself(ObjectClass::kUnknown);
  const BearingLines lines(tracks_, pointing_, config_.estimators.alignment, with_tracklets);
  auto slews =
      slews_.plan(now_us, admission_.stations(), lines, tracks_.tracks(), cues_, handover_);
  log_.count("slews", static_cast<double>(slews.size()));
  return slews;
}

// Without bearings, only cues cause slews, and "now" is this host's time. With bearings, "now" is
// message time: alternating between two clocks would restart rounds and searches.
std::vector<Slew> Fusion::add(const Cue& cue, std::int64_t present_us) {
  constexpr double kTogether_s = 0.5;
  const CueRefusal refusal = cues_.take(cue, present_us, admission_.stations());
  log_.count(refusal == CueRefusal::kNone ? "cues" : to_string(refusal));
  if (refusal != CueRefusal::kNone) {
    log_.last_error = "cue " + cue.id + ": " + refusal_words(to_string(refusal));
    return {};
  }
  const bool has_bearings = std::abs(seconds(now_us() - present_us)) < kTogether_s;
  const std::int64_t now = has_bearings ? now_us() : present_us;
  std::vector<Slew> slews;
  do {
    std::ranges::move(slews_at(now), std::back_inserter(slews));
  } while (slews_.is_in_round());
  return slews;
}

bool Fusion::allow_cue(const std::string& id, bool allow) {
  const auto target = target_named(id);
  const bool taken = target ? handover_.order(*target, allow) : cues_.order(id, allow);
  log_.count(taken ? "cue_orders" : "cue_orders_refused");
  if (!taken) {
    log_.last_error = (target ? "target " : "cue ") + id + ": unknown, or the " +
                      (target ? "hand-over" : "search for cues") + " is switched off";
  }
  return taken;
}

// An offset from the other stations' clocks is added to the stated clock error. `used` gets the
// images of which a bearing was used.
BearingRefusal Fusion::take(const BearingMeasurement& measurement,
                            std::vector<ImageBearings>& used) {
  BearingMeasurement judged = measurement;
  const double added_sd_s = admission_.clocks().added_sd_s(measurement.station);
  judged.clock_sd_s = std::hypot(measurement.clock_sd_s, added_sd_s);
  BearingRefusal own = BearingRefusal::kNone;
  for (ImageBearings& image : images_.add(judged, now_us())) {
    const bool is_own = image.front().station == measurement.station &&
                        image.front().utime_us == measurement.utime_us;
    const std::vector<BearingRefusal> refusals = associate(image);
    for (std::size_t i = 0; i + (is_own ? 1 : 0) < image.size(); ++i) {
      if (refusals[i] != BearingRefusal::kNone) log_.count(to_string(refusals[i]));
    }
    if (is_own) own = refusals.back();
    const bool is_used = std::ranges::count(refusals, BearingRefusal::kNone) > 0;
    if (is_used) used.push_back(std::move(image));
  }
  return own;
}

std::vector<BearingRefusal> Fusion::associate(const ImageBearings& image) {
  const std::string& station = image.front().station;
  std::vector<BearingRefusal> refusals;
  for (const Associated& associated : ols::fusion::associate(image, tracks_, pointing_)) {
    const BearingMeasurement& measurement = image[refusals.size()];
    if (associated.explained && associated.result.track_id != 0) {
      admission_.note_target(measurement, associated.result.track_id);
    }
    note_unassociated(measurement, associated.result);
    if (associated.newly_so) log_.quarantine(station, pointing_.quarantine(station));
    const bool used = associated.explained || !associated.quarantined;
    refusals.push_back(used ? BearingRefusal::kNone : BearingRefusal::kQuarantine);
  }
  return refusals;
}

// A tentative track counts neither as an explanation nor as a contradiction.
void Fusion::note_unassociated(const BearingMeasurement& measurement, const Association& result) {
  const bool by_none =
      result.kind == Association::Kind::kUnexplained || result.kind == Association::Kind::kRejected;
  if (!by_none) {
    const bool by_tentative = result.kind == Association::Kind::kTrack && result.track_id == 0;
    if (!by_tentative) unassociated_.explained(measurement.station);
  } else if (!std::ranges::any_of(tracks_.tracks(), is_established)) {
    unassociated_.explained(measurement.station);
  } else if (measurement.track_id != 0 && !measurement.is_tracklet) {
    unassociated_.unexplained(measurement.station, measurement.utime_us);
  }
}

void Fusion::forget(const std::string& station) {
  images_.forget(station);
  pointing_.forget(station);
  unassociated_.forget(station);
  tracks_.forget_station(station);
  targets_.forget(station);
  slews_.forget(station);
  tracks_.forget_obstacles(station);
  occlusions_.forget(station);
}

void Fusion::forget_what_changed(const BearingMeasurement& measurement, const Admitted& admitted) {
  if (admitted.evicted) forget(*admitted.evicted);
  if (admitted.recalibrated) {
    tracks_.forget_errors(measurement.station);
    tracks_.forget_losses(measurement.station);
    pointing_.forget(measurement.station);
  }
  if (admitted.restarted) {
    tracks_.forget_followed(measurement.station);
    unassociated_.forget(measurement.station);
    slews_.forget_tracklets(measurement.station);
  }
}

void Fusion::note_refusal(BearingRefusal refusal, const BearingMeasurement& measurement,
                          const Admitted& admitted) {
  constexpr int kManyUntimely = 10;  // fewer are normal while stations begin or the network stalls
  if (refusal == BearingRefusal::kNone) return;
  log_.count(to_string(refusal));
  // Low belief is normal, and a quarantine is reported when it begins.
  if (refusal == BearingRefusal::kLowBelief || refusal == BearingRefusal::kQuarantine) return;
  const int untimely = admitted.station == nullptr ? 0 : admitted.station->untimely;
  if (untimely > 0 && untimely < kManyUntimely) return;
  log_.error(measurement.station, std::string(in_words(refusal)));
}

void Fusion::begin_time_line() {
  log_.count("time_stepped_back");
  log_.last_error = "message time stepped back: a new replay, or most stations' clocks changed";
  images_.clear();
  targets_.clear();
  slews_.clear();
  occlusions_.clear();
  handover_.clear();
  tracks_.clear();
  pointing_.clear();
  unassociated_.clear();
  admission_.begin_time_line();
}

void Fusion::add_land_alarms(std::vector<Alarm>& alarms) const {
  if (!config_.land.surface) return;
  for (const auto& [name, station] : admission_.stations().all()) {
    const StationTraits& traits = station.traits;
    if (traits.camera_ecef.isZero()) continue;  // no bearing yet
    const Alarm alarm =
        station_on_land(name, traits.camera_ecef, traits.camera_sd_enu_m, *config_.land.surface);
    if (!alarm.empty()) alarms.push_back(alarm);
  }
  for (const auto& [station, place] : tracks_.losses().places()) {
    alarms.push_back(alarm::targets_lost_at_place(
        station, degrees(place.from_azimuth_rad), degrees(place.to_azimuth_rad),
        degrees(place.from_elevation_rad), degrees(place.to_elevation_rad)));
  }
}

FusionHealth Fusion::health(std::int64_t present_us) const {
  FusionHealth health = health_of(admission_, pointing_, unassociated_, tracks_, log_);
  add_land_alarms(health.alarms);
  health.cues = cues_.health(present_us == 0 ? now_us() : present_us);
  std::ranges::move(handover_.health(now_us()), std::back_inserter(health.cues));
  health.handover = handover_.mode();
  return health;
}

}  // namespace ols::fusion
