#include "dev/estimators/handover_site.h"

#include <algorithm>
#include <cmath>

#include "dev/estimators/bearing_world.h"
#include "geometry/angles.h"

namespace ols::bench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTick_s = 0.01;
constexpr double kStatus_s = 0.5;
constexpr double kSizeM = 0.5, kSignalAt1M = 5e6;

AzimuthElevation direction(const Vector3d& from_ecef, const Vector3d& to_ecef) {
  return azimuth_elevation_from_enu(R_ecef_enu(from_ecef).transpose() * (to_ecef - from_ecef));
}

double angle_of(const AzimuthElevation& a, const AzimuthElevation& b) {
  return angle_between(enu_from_azimuth_elevation(a), enu_from_azimuth_elevation(b));
}

}  // namespace

HandoverSite::HandoverSite(const HandoverSiteConfig& config, std::uint64_t seed)
    : config_(config), random_(seed), fusion_({.handover = config.handover}) {
  const AzimuthElevation north{0.0, 0.2};
  for (std::size_t i = 0; i < config.stations_enu.size(); ++i) {
    stations_.push_back(
        {name_of_station(i), site().to_ecef(config.stations_enu[i]), !config.stations_turn, north});
  }
  if (config.overview_enu) {
    stations_.push_back({"overview", site().to_ecef(*config.overview_enu), true, north});
  }
}

std::int64_t HandoverSite::utime_us(double time_s) const {
  return kStartUs + std::llround(1e6 * time_s);
}

Vector3d HandoverSite::place(std::size_t target, double time_s) const {
  const FlyingTarget& t = config_.targets[target];
  return site().to_ecef(t.p_enu + (time_s - t.appears_s) * t.v_enu);
}

bool HandoverSite::is_there(std::size_t target, double time_s) const {
  return time_s >= config_.targets[target].appears_s;
}

// A slewed station's tracker takes what is there and follows it until a slew lets go of it.
void HandoverSite::acquire(Station& station) {
  if (!config_.stations_track || station.sees_all) return;
  if (station.follows && !station.track_ids.contains(*station.follows)) station.follows.reset();
  const auto& slew = station.slew;
  if (!slew) return;
  if (station.follows && slew->let_go_track_id == station.track_ids.at(*station.follows)) {
    station.track_ids[*station.follows] = next_track_id_++;
    station.follows.reset();
  }
  const double now_s = kTick_s * static_cast<double>(tick_);
  const double there_rad = std::max(0.01, 4.0 * slew->direction_sd_rad);
  for (const auto& [target, id] : station.track_ids) {
    const double off_rad =
        angle_of(direction(station.p_ecef, place(target, now_s)), slew->direction);
    const bool is_it = slew->line.isZero() ? off_rad < there_rad : off_rad < 0.5 * config_.view_rad;
    if (!station.follows && is_it) station.follows = target;
  }
}

// As the servo reaches with a pan-tilt unit (LineSearchConfig).
void HandoverSite::turn(Station& station) {
  const double now_s = kTick_s * static_cast<double>(tick_);
  if (station.slew && now_s - 1e-6 * static_cast<double>(station.slew->effect_utime_us - kStartUs) >
                          station.slew->lease_s) {
    station.slew.reset();
  }
  if (station.sees_all || (!station.slew && !station.follows)) return;
  const fusion::LineSearchConfig unit;
  AzimuthElevation goal;
  if (station.follows) {
    goal = direction(station.p_ecef, place(*station.follows, now_s));
  } else {
    const fusion::Slew& slew = *station.slew;
    const double dt_s = now_s - 1e-6 * static_cast<double>(slew.effect_utime_us - kStartUs);
    goal = {slew.direction.azimuth_rad + dt_s * slew.azimuth_rate_rad_s,
            slew.direction.elevation_rad + dt_s * slew.elevation_rate_rad_s};
  }
  const double away_rad = angle_of(station.axis, goal);
  station.speed_rad_s =
      std::min({unit.speed_rad_s, station.speed_rad_s + unit.acceleration_rad_s2 * kTick_s,
                std::sqrt(2.0 * unit.acceleration_rad_s2 * away_rad)});
  const double share =
      away_rad > 0.0 ? std::min(1.0, station.speed_rad_s * kTick_s / away_rad) : 1.0;
  station.axis.azimuth_rad = wrap_two_pi(
      station.axis.azimuth_rad + share * wrap_pi(goal.azimuth_rad - station.axis.azimuth_rad));
  station.axis.elevation_rad += share * (goal.elevation_rad - station.axis.elevation_rad);
}

fusion::BearingMeasurement HandoverSite::measured(const Station& station, std::size_t target,
                                                  const AzimuthElevation& there) {
  constexpr double kStepS = 0.02;
  std::normal_distribution<double> normal;
  const double now_s = kTick_s * static_cast<double>(tick_);
  fusion::BearingMeasurement m;
  m.station = station.name;
  m.utime_us = utime_us(now_s);
  m.sight.origin_ecef = station.p_ecef;
  m.sight.direction = {wrap_two_pi(there.azimuth_rad + config_.noise_rad * normal(random_) /
                                                           std::cos(there.elevation_rad)),
                       there.elevation_rad + config_.noise_rad * normal(random_)};
  m.sight.covariance_white = Eigen::Matrix2d::Identity() * std::pow(config_.noise_rad, 2);
  m.is_tracklet = station.follows != target;
  m.is_acquired = !m.is_tracklet;
  m.track_id = station.track_ids.at(target);
  m.boot_id = boots_;
  const AzimuthElevation next = direction(station.p_ecef, place(target, now_s + kStepS));
  const double rate_sd_rad_s = 2e-3, range_m = (place(target, now_s) - station.p_ecef).norm();
  m.sighted.rate_rad_s =
      Vector2d(wrap_pi(next.azimuth_rad - there.azimuth_rad) * std::cos(there.elevation_rad),
               next.elevation_rad - there.elevation_rad) /
          kStepS +
      rate_sd_rad_s * Vector2d(normal(random_), normal(random_));
  m.sighted.rate_covariance = Eigen::Matrix2d::Identity() * rate_sd_rad_s * rate_sd_rad_s;
  m.sighted.size_rad = std::hypot(kSizeM / range_m, 3.0 * config_.noise_rad);
  m.sighted.size_sd_rad = 3.0 * config_.noise_rad;
  m.sighted.signal = kSignalAt1M * kSizeM / (range_m * range_m);
  return m;
}

void HandoverSite::look(Station& station) {
  const double now_s = kTick_s * static_cast<double>(tick_);
  for (std::size_t k = 0; k < config_.targets.size(); ++k) {
    const AzimuthElevation there = direction(station.p_ecef, place(k, now_s));
    const bool is_in_view =
        is_there(k, now_s) &&
        (station.sees_all || angle_of(station.axis, there) < 0.5 * config_.view_rad);
    if (!is_in_view) {
      station.in_view_s.erase(k);
      station.track_ids.erase(k);
      continue;
    }
    const double since_s = station.in_view_s.try_emplace(k, now_s).first->second;
    if (now_s - since_s < config_.confirm_s) continue;
    if (!station.track_ids.contains(k)) station.track_ids[k] = next_track_id_++;
    if (station.name == "overview") first_seen_s_.try_emplace(k, now_s);
    sent_.push_back({now_s + config_.delay_s, measured(station, k, there)});
  }
}

void HandoverSite::deliver() {
  const double now_s = kTick_s * static_cast<double>(tick_);
  std::vector<Sent> due;
  std::erase_if(sent_, [&](const Sent& sent) {
    if (sent.at_s <= now_s) due.push_back(sent);
    return sent.at_s <= now_s;
  });
  for (const Sent& sent : due) {
    for (const fusion::Slew& slew : fusion_.add(sent.bearing).slews) {
      slews_.emplace_back(now_s + config_.slew_s, slew);
    }
  }
  std::erase_if(slews_, [&](const auto& slew) {
    if (slew.first > now_s) return false;
    std::ranges::find(stations_, slew.second.station, &Station::name)->slew = slew.second;
    return true;
  });
}

void HandoverSite::run_until(double time_s) {
  const auto frame = static_cast<std::int64_t>(std::lround(1.0 / (config_.rate_hz * kTick_s)));
  const auto status = static_cast<std::int64_t>(kStatus_s / kTick_s);
  for (; kTick_s * static_cast<double>(tick_) < time_s; ++tick_) {
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      Station& station = stations_[i];
      acquire(station);
      turn(station);
      if ((tick_ + static_cast<std::int64_t>(i)) % frame == 0) look(station);
      if (tick_ % status != 0) continue;
      fusion::StationTraits traits;
      traits.camera_ecef = station.p_ecef;
      traits.field_of_view_rad = station.sees_all ? kPi : config_.view_rad;
      traits.axis = station.axis;
      traits.commandable = !station.sees_all;
      fusion_.know_station(station.name, traits);
    }
    deliver();
  }
}

void HandoverSite::restart_stations() {
  ++boots_;
  next_track_id_ = 1;
  for (Station& station : stations_) station.track_ids.clear();
}

std::vector<std::string> HandoverSite::holders(std::size_t target) const {
  std::vector<std::string> names;
  for (const Station& station : stations_) {
    if (station.name != "overview" && station.track_ids.contains(target)) {
      names.push_back(station.name);
    }
  }
  return names;
}

double HandoverSite::farthest_turn_s(std::size_t target) const {
  double longest_s = 0.0;
  const Vector3d there = place(target, kTick_s * static_cast<double>(tick_));
  for (const Station& station : stations_) {
    if (station.sees_all) continue;
    const double away_rad = angle_of(station.axis, direction(station.p_ecef, there));
    longest_s = std::max(longest_s, fusion::turning_s(away_rad, {.settle_s = 0.0}));
  }
  return longest_s;
}

std::int64_t HandoverSite::found(std::size_t target) const {
  constexpr double kNearM = 5.0;
  const double now_s = kTick_s * static_cast<double>(tick_);
  for (const fusion::Track& track : fusion_.tracks().tracks()) {
    const Vector3d p_ecef = track.filter.at(utime_us(now_s)).mean.head<3>();
    if (is_established(track) && (p_ecef - place(target, now_s)).norm() < kNearM) return track.id;
  }
  return 0;
}

std::optional<double> HandoverSite::first_seen_s(std::size_t target) const {
  const auto seen = first_seen_s_.find(target);
  return seen == first_seen_s_.end() ? std::nullopt : std::optional(seen->second);
}

}  // namespace ols::bench
