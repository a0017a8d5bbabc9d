#include "central/fusion/slew_planner.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "central/measurement/activity.h"
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

std::string cue_key(const CueAim& aim) { return "cue/" + aim.cue.id; }
std::string line_key(const CueAim& aim) { return cue_key(aim) + "/line"; }
std::string line_key(const CueRay& ray) { return ray.station + "/" + std::to_string(ray.track_id); }

}  // namespace

const BearingMeasurement* newest_of(const Track& track,
                                    const std::vector<BearingMeasurement>& bearings,
                                    bool is_tracklet, std::int64_t now_us) {
  const std::int64_t last_us = is_tracklet ? track.last.tracklet_us : track.last.tracker_us;
  if (seconds(now_us - last_us) >= Activity::kFollowsS) return nullptr;
  const auto newest = std::ranges::find(bearings.rbegin(), bearings.rend(), is_tracklet,
                                        &BearingMeasurement::is_tracklet);
  const bool is_there =
      newest != bearings.rend() && seconds(now_us - newest->utime_us) < Activity::kFollowsS;
  return is_there ? &*newest : nullptr;
}

const BearingMeasurement* tracker_of(const Track& track, const std::string& station,
                                     std::int64_t now_us) {
  const auto own = track.bearings.find(station);
  return own == track.bearings.end() ? nullptr : newest_of(track, own->second, false, now_us);
}

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
  constexpr double kLimit = kSlewRateLimit_rad_s;
  // Near the zenith no PTU follows the azimuth; the rate stays finite.
  slew.azimuth_rate_rad_s =
      std::clamp(rate(0) / std::max(0.01, std::cos(slew.direction.elevation_rad)), -kLimit, kLimit);
  slew.elevation_rate_rad_s = std::clamp(rate(1), -kLimit, kLimit);
  const Eigen::Matrix3d own = R * station.camera_sd_enu_m.cwiseAbs2().asDiagonal() * R.transpose();
  const Eigen::Matrix2d spread =
      tangent.transpose() * (target.covariance.topLeftCorner<3, 3>() + own) * tangent;
  slew.direction_sd_rad = std::min(kPi, std::sqrt(spread.trace() / 2.0) / range_m);
  return slew;
}

// "Now" may step back a little.
double SlewPlanner::Search::searched_s(std::int64_t now_us) const {
  return std::max(0.0, seconds(now_us - begun_us));
}

SlewPlanner::Search& SlewPlanner::search_of(const std::string& station, std::int64_t target_id,
                                            const std::string& ray, std::int64_t now_us) {
  Search& search = searches_[station];
  if (search.begun_us == 0 || search.target_id != target_id || search.ray != ray) {
    search = {target_id, ray, now_us};
  }
  return search;
}

void SlewPlanner::allocate(SlewRound& round, std::span<const SlewStation> stations,
                           const std::vector<Track>& tracks) const {
  std::vector<AllocatedTarget> targets;
  std::unordered_map<std::int64_t, const Track*> with_position;
  for (const Track* track : targets_of(round, tracks)) {
    with_position[track->id] = track;
    const auto priority = round.priority.find(track->id);
    targets.push_back({track->id, track->filter.position(),
                       priority == round.priority.end() ? 1.0 : priority->second,
                       round.wanted.contains(track->id)});
    round.targets.insert(track->id);
  }
  std::vector<AllocatedStation> all;
  all.reserve(stations.size());
  for (const SlewStation& station : stations) {
    const auto& traits = station.traits;
    AllocatedStation one{station.station, traits.camera_ecef, traits.axis, station.is_led(),
                         station.follows};
    if (const auto seen = with_position.find(station.follows); seen != with_position.end()) {
      const BearingMeasurement* own = tracker_of(*seen->second, station.station, round.now_us);
      // A tracker there, even a coasting one, has had a bearing within the last second.
      one.by_detector = own == nullptr && seen->second->bearings.contains(station.station);
      one.keeps_tracker = own != nullptr && !own->is_acquired;
    }
    one.is_busy = round.busy.contains(station.station);
    if (const auto search = searches_.find(station.station); search != searches_.end()) {
      one.led_to = search->second.target_id;
      one.searches = search->second.sweep.has_value();
    }
    one.may_search = !round.bearing_only_stations.contains(station.station);
    all.push_back(std::move(one));
  }
  std::optional<Eigen::Vector3d> line;
  if (round.ray) line = round.ray->origin_ecef + round.prior.range_m * round.ray->direction_ecef;
  round.allocation = fusion::allocate(targets, all, config_.line, line);
}

std::vector<const Track*> SlewPlanner::targets_of(const SlewRound& round,
                                                  const std::vector<Track>& tracks) const {
  std::vector<const Track*> targets;
  for (const Track& track : tracks) {
    const auto priority = round.priority.find(track.id);
    const bool leads = priority == round.priority.end() || priority->second > 0.0;
    if (leads && is_established(track) &&
        seconds(round.now_us - track.filter.utime_us()) <= config_.coast_s &&
        seconds(round.now_us - track.last_two_station_us) <= config_.coast_s) {
      targets.push_back(&track);
    }
  }
  return targets;
}

const Track* SlewPlanner::target_for(SlewRound& round, const SlewStation& station,
                                     const std::vector<const Track*>& targets) {
  const auto own = round.allocation.find(station.station);
  if (own == round.allocation.end()) return nullptr;
  const auto target = std::ranges::find(targets, own->second, &Track::id);
  if (target == targets.end()) return nullptr;
  const auto search = searches_.find(station.station);
  const bool is_led_to = search != searches_.end() && search->second.target_id == own->second;
  if (station.follows == own->second) {
    searches_.erase(station.station);
  } else if (!is_led_to) {
    ++round.seen_by[own->second];
  }
  return *target;
}

// The cue that the station is already led to, else the one with the fewest stations. A station with
// a target gets a cue only if two others see that target, and while fewer than two stations are led
// to the cue.
const CueAim* SlewPlanner::cue_for(const SlewRound& round, const SlewStation& station,
                                   const Track* target) {
  if (round.cues.empty() || round.bearing_only_stations.contains(station.station)) return nullptr;
  if (target != nullptr && target->id == station.follows) return nullptr;
  const auto led_to = [&](const CueAim& aim) {
    const auto found = round.led_to.find(aim.cue.id);
    return found == round.led_to.end() ? 0 : found->second;
  };
  const auto own = searches_.find(station.station);
  const CueAim* fewest = nullptr;
  for (const CueAim& aim : round.cues) {
    if (own != searches_.end() && own->second.cue == aim.cue.id) return &aim;
    if (fewest == nullptr || led_to(aim) < led_to(*fewest)) fewest = &aim;
  }
  if (target == nullptr) return fewest;
  const auto seen = round.seen_by.find(target->id);
  const int others = seen == round.seen_by.end() ? 0 : seen->second;
  return led_to(*fewest) < 2 && others >= 2 ? fewest : nullptr;
}

// A search ends with its cue. If the cue comes back, a new search begins.
void SlewPlanner::count_searches(SlewRound& round) {
  round.led_to.clear();
  for (const CueAim& aim : round.cues) round.led_to[aim.cue.id] = 0;
  std::erase_if(searches_, [&](const auto& search) {
    const std::string& cue = search.second.cue;
    if (cue.empty()) return false;
    const auto led_to = round.led_to.find(cue);
    if (led_to == round.led_to.end()) return true;
    ++led_to->second;
    return false;
  });
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
  const Search& search = search_of(station.station, track.id, "", now_us);
  search_around(slew, station, search.searched_s(now_us));
  return slew;
}

void SlewPlanner::search_around(Slew& slew, const SlewStation& station, double searched_s) const {
  const double step_rad = config_.view_share * station.traits.field_of_view_rad;
  const double reach_rad = config_.search_sigma * slew.direction_sd_rad;
  if (reach_rad <= step_rad) return;
  const double points = std::min(1e4, 1.0 + kPi * std::pow(reach_rad / step_rad, 2));
  const int k = static_cast<int>(std::fmod(searched_s / config_.dwell_s, std::floor(points)));
  turn(slew, step_rad * spiral_point(k));
}

// Whether the station is to acquire anything that moves evenly (slew_t.line), instead of what is at
// the direction. True where the cue's velocity is not known, and where the cue's positions are so
// uncertain that they jump more than the target does. Nothing that stands still is found that way,
// so a standing cue is searched by its direction alone.
bool SlewPlanner::is_by_motion(const CueAim& aim, const SlewStation& station,
                               std::int64_t now_us) const {
  constexpr double kKnown_rad_s = 0.03;  // error of the rate that a station's acquisition tolerates
  const KinematicState state = aim.at(now_us);
  const double range_m = (state.mean.head<3>() - station.traits.camera_ecef).norm();
  if (aim.cue.velocity_sd_m_s > kKnown_rad_s * range_m) return true;
  const bool moves = aim.cue.velocity_enu_m_s.norm() > 3.0 * aim.cue.velocity_sd_m_s;
  return moves && is_wide(aim, station, now_us);
}

// A station is usually near its own target, but may be turned far away from a cue: the search
// begins when it has arrived.
Slew SlewPlanner::towards(const CueAim& aim, const SlewStation& station, std::int64_t now_us) {
  const std::int64_t effect_us = effect_of(station.traits, now_us);
  Slew slew = slew_to(aim.at(effect_us), station.traits, config_);
  slew.effect_utime_us = effect_us;
  if (is_by_motion(aim, station, now_us)) slew.line = Eigen::Vector2d::UnitX();
  Search& search = search_of(station.station, 0, cue_key(aim), now_us);
  if (!search.turn_s) {
    const auto& axis = station.traits.axis;
    const double angle_rad = axis ? angle_between(enu_from_azimuth_elevation(*axis),
                                                  enu_from_azimuth_elevation(slew.direction))
                                  : kPi / 4.0;
    search.turn_s = turning_s(angle_rad, config_.line);
  }
  search_around(slew, station, std::max(0.0, search.searched_s(now_us) - *search.turn_s));
  return slew;
}

// Whether the cue's uncertainty exceeds the field of view.
bool SlewPlanner::is_wide(const CueAim& cue, const SlewStation& station,
                          std::int64_t now_us) const {
  const KinematicState state = cue.at(now_us);
  const double range_m = (state.mean.head<3>() - station.traits.camera_ecef).norm();
  const double sd_m = std::sqrt(state.covariance.topLeftCorner<3, 3>().trace() / 3.0);
  return config_.search_sigma * sd_m >
         config_.view_share * station.traits.field_of_view_rad * range_m;
}

Slew SlewPlanner::along(const SlewRound& round, const SlewStation& station,
                        const std::string& search_key) {
  Slew slew;
  slew.lease_s = config_.lease_s;
  slew.effect_utime_us = effect_of(station.traits, round.now_us);
  const CueRay ray = round.ray->at(slew.effect_utime_us);
  Search& search = search_of(station.station, 0, search_key, round.now_us);
  if (!search.sweep) {
    const auto share = round.shares.find(station.station);
    const SweepStart start = sweep_start(
        round.prior, share == round.shares.end() ? LineShare{} : share->second, config_.line);
    search.sweep.emplace(ray, station.traits, start, config_.line);
  }
  const LineLook look = search.sweep->look(ray, station.traits, search.searched_s(round.now_us));
  slew.direction = look.direction;
  slew.direction_sd_rad = look.sd_rad;
  slew.line = look.line;
  constexpr double kLimit = kSlewRateLimit_rad_s;
  slew.azimuth_rate_rad_s =
      std::clamp(look.rate_rad_s.x() / std::max(0.01, std::cos(look.direction.elevation_rad)),
                 -kLimit, kLimit);
  slew.elevation_rate_rad_s = std::clamp(look.rate_rad_s.y(), -kLimit, kLimit);
  return slew;
}

std::optional<Slew> SlewPlanner::slew_of(SlewRound& round, const SlewStation& station,
                                         const std::vector<const Track*>& targets) {
  const Track* target = target_for(round, station, targets);
  if (const CueAim* cue = cue_for(round, station, target)) {
    const bool by_line = round.cue_on_ray == cue->cue.id && is_wide(*cue, station, round.now_us);
    const bool is_new = searches_[station.station].cue != cue->cue.id;
    const Slew slew =
        by_line ? along(round, station, line_key(*cue)) : towards(*cue, station, round.now_us);
    searches_[station.station].cue = cue->cue.id;
    if (is_new) ++round.led_to[cue->cue.id];
    return slew;
  }
  if (target != nullptr) return towards(*target, station, round.now_us);
  const bool searches = round.ray && !round.bearing_only_stations.contains(station.station);
  if (searches) return along(round, station, line_key(*round.ray));
  if (station.let_go_track_id != 0 && station.traits.axis) return stay(station, round.now_us);
  return std::nullopt;
}

// No target needs the station: it only has to let its object go, and not to acquire another one
// there. Among slews without a target and a line, only this one has an exact direction.
Slew SlewPlanner::stay(const SlewStation& station, std::int64_t now_us) const {
  Slew slew;
  slew.lease_s = config_.lease_s;
  slew.effect_utime_us = effect_of(station.traits, now_us);
  slew.direction = *station.traits.axis;
  return slew;
}

std::vector<Slew> SlewPlanner::plan(SlewRound& round, std::span<const SlewStation> stations,
                                    const std::vector<Track>& tracks) {
  const std::int64_t now_us = round.now_us;
  const std::vector<const Track*> targets = targets_of(round, tracks);
  count_searches(round);
  std::vector<Slew> slews;
  for (const SlewStation& station : stations) {
    if (!station.is_led()) {
      searches_.erase(station.station);
      continue;
    }
    auto slew = slew_of(round, station, targets);
    if (!slew) continue;
    slew->station = station.station;
    slew->utime_us = now_us;
    slew->let_go_track_id = station.let_go_track_id;
    slews.push_back(std::move(*slew));
  }
  return slews;
}

}  // namespace ols::fusion
