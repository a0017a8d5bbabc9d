#include "central/fusion/slew_planner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "central/measurement/time_span.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"

namespace ols::fusion {
namespace {

// A tenth remains for the difference of two clocks.
constexpr double kLongestLead_s = 0.9 * kSlewLead_s;

void turn(Slew& slew, const Eigen::Vector2d& offset_rad) {
  AzimuthElevation& d = slew.direction;
  const double elevation = std::clamp(d.elevation_rad + offset_rad.y(), -kPi / 2.0, kPi / 2.0);
  d.azimuth_rad =
      wrap_two_pi(d.azimuth_rad + offset_rad.x() / std::max(0.05, std::cos(d.elevation_rad)));
  d.elevation_rad = elevation;
}

}  // namespace

// The arc length of the spiral is the square of the angle over 4 pi; its turns are a unit apart.
Eigen::Vector2d spiral_point(int k) {
  const double radius = std::sqrt(k / kPi), angle = std::sqrt(4.0 * kPi * k);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

Slew slew_to(const KinematicState& target, const StationTraits& station, const SlewConfig& config) {
  const Eigen::Vector3d& camera_ecef = station.camera_ecef;
  const Eigen::Vector3d position = target.mean.head<3>(), velocity = target.mean.segment<3>(3);
  const Eigen::Matrix3d R = R_ecef_enu(camera_ecef);
  const Eigen::Vector3d line_enu = R.transpose() * (position - camera_ecef);
  const double range_m = std::max(1e-3, line_enu.norm());
  Slew slew;
  slew.lease_s = config.lease_s;
  slew.direction = azimuth_elevation_from_enu(line_enu);
  const Eigen::Matrix<double, 3, 2> tangent = R * tangent_basis(slew.direction);
  const Eigen::Vector2d rate = tangent.transpose() * velocity / range_m;
  const double limit = config.rate_limit_rad_s;
  // Near the zenith no PTU follows the azimuth; the rate stays finite.
  slew.azimuth_rate_rad_s =
      std::clamp(rate(0) / std::max(0.01, std::cos(slew.direction.elevation_rad)), -limit, limit);
  slew.elevation_rate_rad_s = std::clamp(rate(1), -limit, limit);
  const Eigen::Matrix3d own = R * station.camera_sd_enu_m.cwiseAbs2().asDiagonal() * R.transpose();
  const Eigen::Matrix2d spread =
      tangent.transpose() * (target.covariance.topLeftCorner<3, 3>() + own) * tangent;
  slew.direction_sd_rad = std::min(kPi, std::sqrt(spread.trace() / 2.0) / range_m);
  return slew;
}

double SlewPlanner::searched_s(const std::string& station, std::int64_t target_id,
                               const std::string& ray, std::int64_t now_us) {
  Search& search = searches_[station];
  if (search.begun_us == 0 || search.target_id != target_id || search.ray != ray) {
    search = {target_id, ray, now_us};
  }
  return std::max(0.0, seconds(now_us - search.begun_us));  // "now" may fall back a little
}

// The target that it sees, else the one that it is being led to, else the one that the fewest see.
const Track* SlewPlanner::target_for(const SlewStation& station,
                                     const std::vector<const Track*>& targets,
                                     std::map<std::int64_t, int>& seen_by) {
  const auto by_id = [&](std::int64_t id) -> const Track* {
    const auto found = std::ranges::find(targets, id, [](const Track* t) { return t->id; });
    return found == targets.end() ? nullptr : *found;
  };
  if (const Track* own = by_id(station.follows)) {
    searches_.erase(station.station);
    return own;
  }
  const auto search = searches_.find(station.station);
  if (search != searches_.end()) {
    if (const Track* led_to = by_id(search->second.target_id)) return led_to;
  }
  if (targets.empty()) return nullptr;
  const Track* fewest = *std::ranges::min_element(
      targets, {}, [&](const Track* t) { return std::pair(seen_by[t->id], t->id); });
  ++seen_by[fewest->id];
  return fewest;
}

std::int64_t SlewPlanner::effect_of(const StationTraits& station, std::int64_t now_us) const {
  const double lead_s = std::min(kLongestLead_s, station.latency_s + config_.act_s);
  return now_us + std::llround(lead_s * 1e6);
}

Slew SlewPlanner::towards(const Track& track, const SlewStation& station, std::int64_t now_us) {
  const std::int64_t effect_us = effect_of(station.traits, now_us);
  Slew slew = slew_to(track.filter.at(effect_us), station.traits, config_);
  slew.effect_utime_us = effect_us;
  slew.target_id = track.id;
  if (station.follows == track.id) return slew;
  const double searched = searched_s(station.station, track.id, "", now_us);
  const double step_rad = config_.view_share * station.traits.field_of_view_rad;
  const double reach_rad = config_.search_sigma * slew.direction_sd_rad;
  if (reach_rad <= step_rad) return slew;
  const double points = std::min(1e4, 1.0 + kPi * std::pow(reach_rad / step_rad, 2));
  const int k = static_cast<int>(std::fmod(searched / config_.dwell_s, std::floor(points)));
  turn(slew, step_rad * spiral_point(k));
  return slew;
}

// Steps along the ray at equal angles as seen from this station, to the far end and back.
Slew SlewPlanner::along(const CueRay& ray, const SlewStation& station, std::int64_t now_us) {
  const Eigen::Vector3d& camera = station.traits.camera_ecef;
  const auto point = [&](double range_m) {
    return Eigen::Vector3d(ray.origin_ecef + range_m * ray.direction_ecef);
  };
  const double step_rad = config_.view_share * station.traits.field_of_view_rad;
  const Eigen::Vector3d near = point(config_.search_near_m) - camera;
  const Eigen::Vector3d far = point(config_.search_far_m) - camera;
  const double sweep_rad = angle_between(near, far);
  const int steps = std::max(1, static_cast<int>(std::ceil(sweep_rad / std::max(1e-4, step_rad))));
  const double searched = searched_s(station.station, 0, ray.station, now_us);
  const int k = static_cast<int>(searched / config_.dwell_s) % (2 * steps);
  const double share = static_cast<double>(k <= steps ? k : 2 * steps - k) / steps;
  // In the plane of the two directions, the direction at this share of the angle between them.
  const Eigen::Vector3d u = near.normalized();
  const Eigen::Vector3d v = (far - far.dot(u) * u).normalized();
  const double angle = share * sweep_rad;
  Eigen::Vector3d line = std::cos(angle) * u;
  if (v.allFinite()) line += std::sin(angle) * v;
  Slew slew;
  slew.lease_s = config_.lease_s;
  slew.effect_utime_us = effect_of(station.traits, now_us);
  slew.direction = azimuth_elevation_from_enu(R_ecef_enu(camera).transpose() * line);
  slew.direction_sd_rad = sweep_rad / 4.0;
  return slew;
}

std::vector<Slew> SlewPlanner::plan(SlewRound& round, std::span<const SlewStation> stations,
                                    const std::vector<Track>& tracks) {
  const std::int64_t now_us = round.now_us;
  std::vector<const Track*> targets;
  for (const Track& track : tracks) {
    if (is_established(track) && seconds(now_us - track.filter.utime_us()) <= config_.coast_s &&
        seconds(now_us - track.last_two_station_us) <= config_.coast_s) {
      targets.push_back(&track);
    }
  }
  std::vector<Slew> slews;
  for (const SlewStation& station : stations) {
    if (!station.traits.commandable) continue;
    const Track* target = target_for(station, targets, round.seen_by);
    const bool searches = round.ray && !round.bearing_only_stations.contains(station.station);
    if (target == nullptr && !searches) continue;
    slews.push_back(target != nullptr ? towards(*target, station, now_us)
                                      : along(*round.ray, station, now_us));
    slews.back().station = station.station;
    slews.back().utime_us = now_us;
  }
  return slews;
}

}  // namespace ols::fusion
