#include "central/fusion/fusion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "central/measurement/time_span.h"

namespace ols {
namespace {

constexpr double kMemoryS = 1.0;      // exposures kept for the recognition of doubled ones
constexpr double kForgottenS = 10.0;  // silent for longer: gives its place to any other
constexpr double kStepBackS = 1.0;    // "now" going back by more is another time line

}  // namespace

Fusion::Fusion(const FusionConfig& config)
    : config_(config),
      time_(config.silence_s),
      clocks_(config.clocks),
      pointing_(config.pointing),
      strays_(config.strays),
      keeper_(config.keeper),
      planner_(config.slew) {
  if (!make_estimator(config.estimator, config.estimators)) {
    throw std::invalid_argument("there is no estimator " + config.estimator);
  }
  for (const char* name : {"bearings", "targets", "targets_without_position", "slews",
                           "clock_stepped_back", "time_stepped_back", "stations_evicted",
                           "stations_quarantined", "calibrations_changed", "stations_restarted"}) {
    counters_[name] = 0.0;
  }
  for (int i = 1; i <= static_cast<int>(SightingRefusal::kLowBelief); ++i) {
    counters_[to_string(static_cast<SightingRefusal>(i))] = 0.0;
  }
}

bool Fusion::belongs(const std::string& station) const {
  return config_.stations.empty() ||
         std::ranges::find(config_.stations, station) != config_.stations.end();
}

void Fusion::know_station(const std::string& station, const StationTraits& traits) {
  if (!belongs(station)) return;
  if (full(station)) {
    const auto longest = longest_silent();
    const bool delivers = longest->second.delivered && time_.silent_s(longest->first) < kForgottenS;
    if (delivers) return;
    evict(longest);
  }
  Station& known = stations_[station];
  known.traits = traits;
  if (!known.delivered) known.heard = ++messages_;
}

void Fusion::allow_slews(const std::string& station, bool allowed) {
  const auto known = stations_.find(station);
  if (known != stations_.end()) known->second.traits.commandable = allowed;
}

FusionOutput Fusion::add(const Sighting& sighting) {
  FusionOutput output;
  output.refusal = admit(sighting);
  if (output.refusal != SightingRefusal::kNone) refuse(output.refusal, sighting);
  const std::int64_t now = now_us();
  if (now == 0) return output;
  // After a silence "now" is old until most stations are heard again: nothing is told by it.
  if (seconds(sighting.utime_us - now) > config_.future_s) return output;
  if (epoch_.utime_us && seconds(*epoch_.utime_us - now) > kStepBackS) notice_step_back();
  locate(now, output);
  plan(now, output);
  return output;
}

bool Fusion::full(const std::string& station) const {
  return stations_.size() >= static_cast<std::size_t>(config_.max_stations) &&
         !stations_.contains(station);
}

// By messages, not by stamps: a station's clock may be wrong. Those without a bearing come first.
std::map<std::string, Fusion::Station>::iterator Fusion::longest_silent() {
  return std::ranges::min_element(stations_, {}, [this](const auto& entry) {
    const Station& station = entry.second;
    return std::tuple(station.delivered, !may_go(entry.first, station), station.heard);
  });
}

// Strangers must not push out who has worked here and still does.
bool Fusion::may_go(const std::string& name, const Station& station) const {
  constexpr std::int64_t kAtHome = 10;  // bearings
  return station.bearings < kAtHome || time_.silent_s(name) > kForgottenS;
}

bool Fusion::make_room(const std::string& station) {
  if (!full(station)) return true;
  const auto longest = longest_silent();
  if (!may_go(longest->first, longest->second)) return false;
  evict(longest);
  return true;
}

void Fusion::evict(std::map<std::string, Station>::iterator station) {
  ++counters_["stations_evicted"];
  last_error_ = "station " + station->first + ": forgotten, too many stations";
  time_.forget(station->first);
  clocks_.forget(station->first);
  pointing_.forget(station->first);
  strays_.forget(station->first);
  keeper_.forget_station(station->first);
  planner_.forget(station->first);
  stations_.erase(station);
}

SightingRefusal Fusion::admit(const Sighting& sighting) {
  const SightingRefusal broken = check(sighting);
  if (broken != SightingRefusal::kNone) return broken;
  if (!belongs(sighting.station)) return SightingRefusal::kUnknown;
  if (!make_room(sighting.station)) return SightingRefusal::kTooMany;
  Station& station = stations_[sighting.station];
  if (!station.delivered) station.stands_where(sighting.sight);
  station.delivered = true;
  station.heard = ++messages_;
  if (time_.hear(sighting.station, sighting.utime_us)) {
    station.lately.clear();
    ++counters_["clock_stepped_back"];
    if (clocks_.quarantine(sighting.station).empty()) {
      last_error_ = "station " + sighting.station + ": its clock has stepped back";
    }
  }
  if (!clock_is_believed(sighting)) {
    station.lately.clear();
    return SightingRefusal::kQuarantine;
  }
  const double ahead_s = seconds(sighting.utime_us - now_us());
  if (ahead_s > config_.future_s) return SightingRefusal::kFuture;
  if (ahead_s < -config_.stale_s) return SightingRefusal::kStale;
  if (sighting.belief < config_.min_belief) return SightingRefusal::kLowBelief;
  const SightingRefusal doubled = store(sighting, station);
  return doubled == SightingRefusal::kNone ? associate(sighting, station) : doubled;
}

bool Fusion::clock_is_believed(const Sighting& sighting) {
  const bool before = clocks_.quarantine(sighting.station).empty();
  clocks_.hear(sighting, time_);
  const std::string& why = clocks_.quarantine(sighting.station);
  time_.trust(sighting.station, why.empty());
  if (before && !why.empty()) {
    ++counters_["stations_quarantined"];
    last_error_ = "station " + sighting.station + ": quarantined, " + why;
  }
  return why.empty();
}

// The same exposure's bearing of the same object, or in the same direction, again?
bool Fusion::is_doubled(const Sighting& sighting, const std::vector<Exposure>& lately) {
  const auto at = std::ranges::lower_bound(lately, sighting.utime_us, {}, &Exposure::utime_us);
  const auto end = std::ranges::upper_bound(lately, sighting.utime_us, {}, &Exposure::utime_us);
  const AzimuthElevation& d = sighting.sight.direction;
  return std::any_of(at, end, [&](const Exposure& e) {
    const bool same_way =
        e.direction.azimuth_rad == d.azimuth_rad && e.direction.elevation_rad == d.elevation_rad;
    return same_way || (sighting.track_id != 0 && e.track_id == sighting.track_id);
  });
}

SightingRefusal Fusion::store(const Sighting& sighting, Station& station) {
  auto& lately = station.lately;
  if (is_doubled(sighting, lately)) return SightingRefusal::kDuplicate;
  // Also what is refused goes on in time, or a flood would lock its station out for good.
  const std::int64_t newest_us =
      lately.empty() ? sighting.utime_us : std::max(sighting.utime_us, lately.back().utime_us);
  const auto first = std::ranges::lower_bound(
      lately, newest_us - static_cast<std::int64_t>(kMemoryS * 1e6), {}, &Exposure::utime_us);
  lately.erase(lately.begin(), first);
  if (static_cast<double>(lately.size()) >= config_.flood_hz * kMemoryS) {
    return SightingRefusal::kFlood;
  }
  const auto later = std::ranges::upper_bound(lately, sighting.utime_us, {}, &Exposure::utime_us);
  lately.insert(later, {sighting.utime_us, sighting.sight.direction, sighting.track_id});
  const double span_s = seconds(lately.back().utime_us - lately.front().utime_us);
  station.rate_hz = span_s > 0.0 ? static_cast<double>(lately.size() - 1) / span_s : 0.0;
  station.stands_where(sighting.sight);
  notice_changes(sighting, station);
  ++station.bearings;
  ++counters_["bearings"];
  return SightingRefusal::kNone;
}

// Of its calibration, and of the process that numbers its objects.
void Fusion::notice_changes(const Sighting& sighting, Station& station) {
  if (station.bearings > 0 && station.calibration_id != sighting.calibration_id) {
    keeper_.errors().forget(sighting.station);
    pointing_.forget(sighting.station);
    ++counters_["calibrations_changed"];
  }
  station.calibration_id = sighting.calibration_id;
  if (station.bearings > 0 && station.boot_id != sighting.boot_id) {
    keeper_.forget_followed(sighting.station);
    strays_.forget(sighting.station);
    station.follows = 0;
    ++counters_["stations_restarted"];
  }
  station.boot_id = sighting.boot_id;
}

// To the track that it belongs to. What a wrong pose shows is told to its monitor.
SightingRefusal Fusion::associate(const Sighting& sighting, Station& station) {
  Sighting judged = sighting;
  judged.clock_sd_s = std::hypot(sighting.clock_sd_s, clocks_.added_sd_s(sighting.station));
  const bool believed = pointing_.quarantine(sighting.station).empty();
  const Association result = keeper_.add(judged, believed);
  const bool explained = result.kind == Association::Kind::kTrack;
  if (explained && result.track_id != 0) {
    station.follows = result.track_id;
    station.followed_us = sighting.utime_us;
  }
  note_stray(sighting, result);
  if (result.kind == Association::Kind::kAmbiguous) return SightingRefusal::kNone;
  std::optional<Eigen::Vector2d> off_rad;
  if (!explained) {
    const auto nearest = keeper_.nearest(sighting);
    if (nearest) off_rad = nearest->off_rad;
  }
  pointing_.hear(sighting.station, sighting.utime_us, explained, off_rad);
  const std::string& why = pointing_.quarantine(sighting.station);
  if (believed && !why.empty()) {
    ++counters_["stations_quarantined"];
    last_error_ = "station " + sighting.station + ": quarantined, " + why;
  }
  return explained || why.empty() ? SightingRefusal::kNone : SightingRefusal::kQuarantine;
}

// A track that is only born explains nothing yet, nor does it deny.
void Fusion::note_stray(const Sighting& sighting, const Association& result) {
  const bool by_none =
      result.kind == Association::Kind::kUnexplained || result.kind == Association::Kind::kSetAside;
  if (!by_none) {
    const bool by_born = result.kind == Association::Kind::kTrack && result.track_id == 0;
    if (!by_born) strays_.agrees(sighting.station);
  } else if (!std::ranges::any_of(keeper_.tracks(), is_sure)) {
    strays_.agrees(sighting.station);
  } else if (sighting.track_id != 0) {
    strays_.strays(sighting.station, sighting.utime_us);
  }
}

void Fusion::refuse(SightingRefusal refusal, const Sighting& sighting) {
  ++counters_[to_string(refusal)];
  // Ordinary, or said when it began.
  if (refusal == SightingRefusal::kLowBelief || refusal == SightingRefusal::kQuarantine) return;
  last_error_ = "station " + sighting.station + ": " + to_string(refusal);
}

void Fusion::notice_step_back() {
  ++counters_["time_stepped_back"];
  last_error_ = "time has stepped back: another replay, or most stations' clocks";
  epoch_ = {};
  slewed_us_.reset();
  slew_next_.reset();
  objects_.clear();
  keeper_.clear();
  planner_.clear();
  clocks_.clear();
  pointing_.clear();
  strays_.clear();
  for (auto& [name, station] : stations_) {
    time_.trust(name, true);
    station.follows = 0;
  }
}

}  // namespace ols
