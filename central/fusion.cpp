#include "central/fusion.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/angles.h"

namespace ols {
namespace {

constexpr std::int64_t kTargetId = 1;
constexpr double kMemoryS = 1.0;      // bearings kept for alignment
constexpr double kForgottenS = 10.0;  // silent for longer: gives its place to any other
constexpr double kStepBackS = 1.0;    // "now" going back by more is another time line
constexpr double kAverageGapS = 1.0;  // the moving average starts anew after a gap

double seconds(std::int64_t span_us) { return static_cast<double>(span_us) * 1e-6; }

bool due(const std::optional<std::int64_t>& last_us, std::int64_t now_us, double rate_hz) {
  // A tenth of tolerance: frames of the same rate must not be missed every other time.
  return !last_us || static_cast<double>(now_us - *last_us) >= 0.9e6 / rate_hz;
}

bool all_finite(const Sighting& s) {
  return s.sight.origin_ecef.allFinite() && s.sight.origin_sd_enu_m.allFinite() &&
         s.sight.covariance_white.allFinite() && s.sight.covariance_systematic.allFinite() &&
         std::isfinite(s.sight.direction.azimuth_rad) &&
         std::isfinite(s.sight.direction.elevation_rad) && std::isfinite(s.belief) &&
         std::isfinite(s.clock_sd_s);
}

bool in_range(const Sighting& s) {
  constexpr double kDeepestM = 6.3e6, kHighestM = 7.0e6;  // from the Earth's centre
  constexpr double kGreatestClockSdS = 1e4, kGreatestOriginSdM = 1e6;
  const double from_centre_m = s.sight.origin_ecef.norm();
  const AzimuthElevation& d = s.sight.direction;
  return !s.station.empty() && s.utime_us > 0 && d.azimuth_rad >= 0.0 &&
         d.azimuth_rad <= 2.0 * kPi && std::abs(d.elevation_rad) <= kPi / 2.0 && s.belief >= 0.0 &&
         s.belief <= 1.0 && s.clock_sd_s >= 0.0 && s.clock_sd_s <= kGreatestClockSdS &&
         from_centre_m > kDeepestM && from_centre_m < kHighestM &&
         s.sight.origin_sd_enu_m.minCoeff() >= 0.0 &&
         s.sight.origin_sd_enu_m.maxCoeff() <= kGreatestOriginSdM;
}

// Determinant; an asymmetric matrix counts with the worse of its two off-diagonal elements.
double determinant(const Eigen::Matrix2d& m) {
  const double off = std::max(std::abs(m(0, 1)), std::abs(m(1, 0)));
  return m(0, 0) * m(1, 1) - off * off;
}

bool variances_within(const Eigen::Matrix2d& m, double least_rad2) {
  constexpr double kGreatestRad2 = 10.0;  // about (180 deg)^2: nothing is known
  return m.diagonal().minCoeff() >= least_rad2 && m.diagonal().maxCoeff() <= kGreatestRad2;
}

// The bounds are far beyond any camera's; outside of them one bearing would upset the arithmetic
// of the whole fit.
bool covariances_hold(const SightLine& sight) {
  constexpr double kLeastWhiteRad2 = 1e-18;
  constexpr double kWorstCondition = 1e8;  // of the white one: greatest eigenvalue over least
  const Eigen::Matrix2d& white = sight.covariance_white;
  const Eigen::Matrix2d& stays = sight.covariance_systematic;
  const double slack = 1e-9 * stays(0, 0) * stays(1, 1);  // rounding of a singular one
  return variances_within(white, kLeastWhiteRad2) && variances_within(stays, 0.0) &&
         determinant(white) >= white.trace() * white.trace() / kWorstCondition &&
         determinant(stays) >= -slack;
}

FusedTarget target_of(std::int64_t epoch_us, const char* estimator, const std::vector<Ray>& rays,
                      Estimate estimate) {
  FusedTarget target;
  target.utime_us = epoch_us;
  target.target_id = kTargetId;
  target.estimator = estimator;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    target.stations.push_back(
        {rays[i].station, estimate.rays[i].used, estimate.rays[i].weight, rays[i].age_s});
  }
  target.estimate = std::move(estimate);
  return target;
}

}  // namespace

const char* to_string(SightingRefusal refusal) {
  switch (refusal) {
    case SightingRefusal::kNone:
      return "none";
    case SightingRefusal::kNotFinite:
      return "refused_not_finite";
    case SightingRefusal::kOutOfRange:
      return "refused_out_of_range";
    case SightingRefusal::kCovariance:
      return "refused_covariance";
    case SightingRefusal::kStale:
      return "refused_stale";
    case SightingRefusal::kFuture:
      return "refused_future";
    case SightingRefusal::kDuplicate:
      return "refused_duplicate";
    case SightingRefusal::kQuarantine:
      return "refused_quarantine";
    case SightingRefusal::kTooMany:
      return "refused_too_many_stations";
    case SightingRefusal::kLowBelief:
      return "unused_low_belief";
  }
  return "unknown";
}

SightingRefusal check(const Sighting& sighting) {
  if (!all_finite(sighting)) return SightingRefusal::kNotFinite;
  if (!in_range(sighting)) return SightingRefusal::kOutOfRange;
  if (!covariances_hold(sighting.sight)) return SightingRefusal::kCovariance;
  return SightingRefusal::kNone;
}

Fusion::Fusion(const FusionConfig& config)
    : config_(config),
      time_(config.alignment.max_age_s),
      monitor_(config.residuals),
      clocks_(config.clocks),
      average_(config.paper_average) {
  for (const char* name : {"bearings", "targets", "targets_without_position", "rays_set_aside",
                           "slews", "clock_stepped_back", "time_stepped_back", "stations_evicted",
                           "stations_quarantined", "calibrations_changed"}) {
    counters_[name] = 0.0;
  }
  for (int i = 1; i <= static_cast<int>(SightingRefusal::kLowBelief); ++i) {
    counters_[to_string(static_cast<SightingRefusal>(i))] = 0.0;
  }
}

void Fusion::know_station(const std::string& station, const Eigen::Vector3d& camera_ecef) {
  if (full(station)) {
    const auto longest = longest_silent();
    const bool delivers = longest->second.delivered && time_.silent_s(longest->first) < kForgottenS;
    if (delivers) return;
    evict(longest);
  }
  Station& known = stations_[station];
  if (known.delivered) return;
  known.camera_ecef = camera_ecef;
  known.heard = ++messages_;
}

FusionOutput Fusion::add(const Sighting& sighting) {
  FusionOutput output;
  output.refusal = admit(sighting);
  if (output.refusal != SightingRefusal::kNone) refuse(output.refusal, sighting);
  const std::int64_t now = now_us();
  if (now == 0) return output;
  if (last_epoch_us_ && seconds(*last_epoch_us_ - now) > kStepBackS) notice_step_back();
  if (due(last_epoch_us_, now, config_.rate_hz)) locate(now, output);
  if (due(last_slew_us_, now, config_.slew.rate_hz)) plan(now, output);
  return output;
}

bool Fusion::full(const std::string& station) const {
  return !stations_.contains(station) &&
         stations_.size() >= static_cast<std::size_t>(config_.max_stations);
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
  monitor_.forget(station->first);
  stations_.erase(station);
}

SightingRefusal Fusion::admit(const Sighting& sighting) {
  const SightingRefusal broken = check(sighting);
  if (broken != SightingRefusal::kNone) return broken;
  if (!make_room(sighting.station)) return SightingRefusal::kTooMany;
  Station& station = stations_[sighting.station];
  if (!station.delivered) station.camera_ecef = sighting.sight.origin_ecef;
  station.delivered = true;
  station.heard = ++messages_;
  if (time_.hear(sighting.station, sighting.utime_us)) {
    station.sightings.clear();
    ++counters_["clock_stepped_back"];
    if (clocks_.quarantine(sighting.station).empty()) {
      last_error_ = "station " + sighting.station + ": its clock has stepped back";
    }
  }
  if (!clock_is_believed(sighting)) {
    station.sightings.clear();
    return SightingRefusal::kQuarantine;
  }
  const double ahead_s = seconds(sighting.utime_us - now_us());
  if (ahead_s > config_.future_s) return SightingRefusal::kFuture;
  if (ahead_s < -config_.stale_s) return SightingRefusal::kStale;
  if (sighting.belief < config_.min_belief) return SightingRefusal::kLowBelief;
  return store(sighting);
}

bool Fusion::clock_is_believed(const Sighting& sighting) {
  const bool before = clocks_.quarantine(sighting.station).empty();
  clocks_.hear(sighting, time_);
  const std::string why = clocks_.quarantine(sighting.station);
  time_.trust(sighting.station, why.empty());
  if (before && !why.empty()) {
    ++counters_["stations_quarantined"];
    last_error_ = "station " + sighting.station + ": quarantined, " + why;
  }
  return why.empty();
}

SightingRefusal Fusion::store(const Sighting& sighting) {
  Station& station = stations_[sighting.station];
  auto& kept = station.sightings;
  if (!kept.empty() && kept.back().calibration_id != sighting.calibration_id) {
    if (sighting.utime_us <= kept.back().utime_us) return SightingRefusal::kStale;
    kept.clear();
    monitor_.forget(sighting.station);
    ++counters_["calibrations_changed"];
  }
  if (!kept.empty() && kept.back().track_id != sighting.track_id) {
    // A late one of the track before must not end the new track.
    if (sighting.utime_us <= kept.back().utime_us) return SightingRefusal::kStale;
    kept.clear();
  }
  const auto place = std::ranges::lower_bound(kept, sighting.utime_us, {}, &Sighting::utime_us);
  if (place != kept.end() && place->utime_us == sighting.utime_us) {
    return SightingRefusal::kDuplicate;
  }
  kept.insert(place, sighting);
  const std::int64_t newest_us = kept.back().utime_us;
  std::erase_if(kept, [newest_us](const Sighting& old) {
    return seconds(newest_us - old.utime_us) > kMemoryS;
  });
  const double span_s = seconds(kept.back().utime_us - kept.front().utime_us);
  station.rate_hz = span_s > 0.0 ? static_cast<double>(kept.size() - 1) / span_s : 0.0;
  station.camera_ecef = kept.back().sight.origin_ecef;
  ++station.bearings;
  ++counters_["bearings"];
  return SightingRefusal::kNone;
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
  last_epoch_us_.reset();
  last_slew_us_.reset();
  last_average_us_.reset();
  last_target_.reset();
  monitor_ = ResidualMonitor(config_.residuals);
  clocks_.clear();
  for (const auto& [name, station] : stations_) time_.trust(name, true);
}

std::vector<Ray> Fusion::rays_at(std::int64_t epoch_us) const {
  std::vector<Ray> rays;
  const bool located = last_target_ && seconds(epoch_us - last_target_->utime_us) < kMemoryS;
  for (const auto& [name, station] : stations_) {
    std::optional<double> range_m;
    if (located) {
      range_m = (last_target_->estimate.position_ecef - station.camera_ecef).norm();
    }
    auto ray = align(station.sightings, epoch_us, range_m, config_.alignment);
    if (!ray) continue;
    ray->clock_sd_s = std::hypot(ray->clock_sd_s, clocks_.added_sd_s(name));
    monitor_.inflate(*ray);
    rays.push_back(std::move(*ray));
  }
  return rays;
}

void Fusion::locate(std::int64_t epoch_us, FusionOutput& output) {
  last_epoch_us_ = epoch_us;
  const std::vector<Ray> rays = rays_at(epoch_us);
  Estimate joint = least_squares(rays, config_.least_squares);
  const bool located = joint.solution == Solution::kOk;
  if (located) {
    estimate_velocity(rays, joint);
    monitor_.observe(rays, joint, epoch_us);
    for (const RayUse& use : joint.rays) counters_["rays_set_aside"] += use.used ? 0.0 : 1.0;
  }
  ++counters_[located ? "targets" : "targets_without_position"];
  output.target = target_of(epoch_us, "least-squares", rays, std::move(joint));
  if (located) last_target_ = output.target;

  Estimate paper = paper_estimate(paper_n_view, rays, config_.paper);
  if (paper.solution == Solution::kOk) {
    if (!last_average_us_ || seconds(epoch_us - *last_average_us_) > kAverageGapS) {
      average_.reset();
    }
    last_average_us_ = epoch_us;
    paper = average_.add(paper);
  }
  output.target_paper = target_of(epoch_us, "paper", rays, std::move(paper));
}

void Fusion::plan(std::int64_t now, FusionOutput& output) {
  if (!last_target_ || seconds(now - last_target_->utime_us) > config_.slew.coast_s) return;
  last_slew_us_ = now;
  for (const auto& [name, station] : stations_) {
    Slew slew = plan_slew(last_target_->estimate, last_target_->utime_us, now, station.camera_ecef,
                          config_.slew);
    slew.station = name;
    slew.target_id = last_target_->target_id;
    output.slews.push_back(std::move(slew));
    ++counters_["slews"];
  }
}

FusionHealth Fusion::health() const {
  FusionHealth health{
      .now_us = now_us(), .stations = {}, .counters = counters_, .last_error = last_error_};
  for (const auto& [name, station] : stations_) {
    const std::int64_t newest = time_.newest_us(name);
    const double age_s =
        newest == 0 ? std::numeric_limits<double>::quiet_NaN() : seconds(health.now_us - newest);
    health.stations.push_back({name, station.bearings, station.rate_hz, age_s, monitor_.rms(name),
                               clocks_.offset_s(name), clocks_.quarantine(name)});
  }
  return health;
}

}  // namespace ols
