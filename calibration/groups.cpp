#include "calibration/groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "calibration/rectification_block.h"
#include "calibration/shared_poses.h"
#include "calibration/trajectory.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

// `one` is an element of the problem's observations.
[[noreturn]] void refuse(const Problem& problem, const Observation& one, const std::string& key,
                         const std::string& why, const Observation* other = nullptr) {
  const auto index = [&problem](const Observation& of) {
    return static_cast<std::size_t>(&of - problem.observations.data());
  };
  throw ObservationRefused(index(one), key, why,
                           other ? std::optional(index(*other)) : std::nullopt);
}

template <class T>
const T& reference_as(const Problem& problem, const Observation& one, const char* what) {
  const auto found = problem.references.find(one.reference);
  if (found == problem.references.end()) {
    refuse(problem, one, "reference", "'" + one.reference + "' is not one of the references");
  }
  const T* reference = std::get_if<T>(&found->second);
  if (!reference) refuse(problem, one, "reference", "'" + one.reference + "' is not " + what);
  return *reference;
}

const Trajectory& trajectory_of(const Problem& problem, const Observation& one) {
  const auto& trajectory =
      reference_as<Trajectory>(problem, one, "a trajectory: two rows with utime_us are needed");
  // An aircraft's stamps may be off by its latency.
  const std::int64_t slack_us = one.kind == Kind::kAircraft ? 5'000'000 : 0;
  if (one.utime_us < trajectory.points.front().utime_us - slack_us ||
      one.utime_us > trajectory.points.back().utime_us + slack_us) {
    refuse(problem, one, "utime_us", "is outside of the trajectory of '" + one.reference + "'");
  }
  const double gap_s = motion_at(trajectory, static_cast<double>(one.utime_us)).gap_s;
  if (gap_s > kLongestGap_s) {
    refuse(problem, one, "utime_us",
           "the positions of '" + one.reference + "' around it are " +
               std::to_string(std::lround(gap_s)) + " s apart: more than " +
               std::to_string(std::lround(kLongestGap_s)) + " s, it may have been anywhere");
  }
  return trajectory;
}

bool is_sun(const Observation& one) {
  return one.kind == Kind::kSun || (one.kind == Kind::kStar && one.reference == "sun");
}

// A name that the references do not give to something else.
std::optional<Planet> planet_seen(const Problem& problem, const Observation& one) {
  if (one.kind != Kind::kStar || problem.references.contains(one.reference)) return std::nullopt;
  return planet_of(one.reference);
}

SkyDirection sky_of(const Problem& problem, const Observation& one) {
  const Geodetic& place = problem.stations[one.station].model.geometry.position;
  const Air air = problem.air.value_or(standard_air(place.height_m));
  if (is_sun(one)) return sun_direction(one.utime_us, place, air, problem.earth);
  if (const auto planet = planet_seen(problem, one)) {
    return planet_direction(*planet, one.utime_us, place, air, problem.earth);
  }
  if (one.reference.empty()) {
    refuse(problem, one, "reference",
           "a star without a name cannot be used: identify the stars first, and give each its row "
           "in the references");
  }
  return star_direction(reference_as<Star>(problem, one, "a star"), one.utime_us, place, air,
                        problem.earth);
}

class Builder {
 public:
  explicit Builder(const Problem& problem) : problem_(problem), poses_(problem.observations) {
    network_.stations = problem.stations;
    network_.names = problem.names;
    network_.ut1_sd_s = problem.ut1_sd_s;
    network_.layout = {problem.stations.size(), poses_.size()};
    for (std::size_t i = 0; i < problem.observations.size(); ++i) {
      const Observation& one = problem.observations[i];
      members_[key_of(one, i)].push_back(i);
    }
  }

  Network build() {
    for (const auto& [key, members] : members_) add(members);
    network_.priors_from = network_.blocks.size();
    for (std::size_t i = 0; i < problem_.stations.size(); ++i) {
      network_.blocks.push_back(
          station_prior_block(network_.layout, i, problem_.stations[i].covariance));
    }
    network_.blocks.push_back(ut1_prior_block(network_.layout, problem_.ut1_sd_s));
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const double sd_rad = problem_.stations[poses_.station(i)].pose_sd_rad;
      network_.blocks.push_back(pose_prior_block(network_.layout, i, sd_rad));
    }
    return std::move(network_);
  }

 private:
  // What belongs to one group: kind, station (of what each station has for itself), name.
  using Key = std::tuple<Kind, std::size_t, std::string>;

  Key key_of(const Observation& one, std::size_t i) const {
    switch (one.kind) {
      case Kind::kStar:
      case Kind::kSun:
        // All sightings of a planet have the error of its theory in common.
        if (planet_seen(problem_, one)) return {one.kind, 0, one.reference};
        return {one.kind, i, one.reference};
      case Kind::kScene:
      case Kind::kInclinometer:
      case Kind::kRuler:  // they tell something together
        return {one.kind, one.station, ""};
      case Kind::kLevelLine:
      case Kind::kCross:
        return {one.kind, one.station, one.reference};
      default:
        return {one.kind, 0, one.reference};
    }
  }

  Sighting sighting_of(std::size_t i) const {
    const Observation& one = problem_.observations[i];
    return {one.station,
            one.utime_us,
            one.reading,
            one.pixel,
            one.sd_px,
            poses_.of(i),
            problem_.stations[one.station].pose_sd_rad};
  }

  TargetPtr target_of(const Observation& one) const {
    switch (one.kind) {
      case Kind::kStation:
        for (std::size_t i = 0; i < problem_.names.size(); ++i) {
          if (problem_.names[i] != one.reference) continue;
          if (i == one.station) refuse(problem_, one, "reference", "the station sights itself");
          return station_target(i);
        }
        [[fallthrough]];
      case Kind::kLandmark:
        return fixed_target(reference_as<FixedPoint>(problem_, one, "a surveyed point"));
      case Kind::kStar:
      case Kind::kSun:
        return sky_target(high_enough(one));
      case Kind::kAircraft:
        return aircraft_target(trajectory_of(problem_, one));
      case Kind::kDrone:
        return drone_target(trajectory_of(problem_, one));
      case Kind::kScene:
        return scene_target();
      default:
        return unknown_target();
    }
  }

  TargetPtr planet_target(Planet planet, const std::vector<std::size_t>& members) const {
    std::vector<SkyPosition> positions;
    positions.reserve(members.size());
    for (const std::size_t i : members) {
      const Observation& one = problem_.observations[i];
      positions.push_back({one.station, one.utime_us, high_enough(one)});
    }
    return body_target(std::move(positions), planet_sd_rad(planet));
  }

  SkyDirection high_enough(const Observation& one) const {
    SkyDirection direction = sky_of(problem_, one);
    if (degrees(direction.elevation_rad) < kLeastElevation_deg) {
      const std::string what = is_sun(one) ? "the sun" : "'" + one.reference + "'";
      const long high_deg = std::lround(degrees(direction.elevation_rad));
      const std::string why =
          high_deg < 0 ? "below the horizon: are the signs of the position and the time right?"
                       : "high: below 10 the refraction is not known well enough";
      refuse(problem_, one, "reference",
             what + " stands " + std::to_string(std::abs(high_deg)) + " degrees " + why);
    }
    return direction;
  }

  // A larger distance means a wrong zone or hemisphere, or exchanged latitude and longitude.
  void check_distance(const Observation& one) const {
    constexpr double kLeast_m = 1.0, kGreatest_m = 500e3;
    const auto found = problem_.references.find(one.reference);
    if (found == problem_.references.end()) return;
    const auto* point = std::get_if<FixedPoint>(&found->second);
    const auto* trajectory = std::get_if<Trajectory>(&found->second);
    if (!point && !trajectory) return;
    const Geodetic& place = problem_.stations[one.station].model.geometry.position;
    const Eigen::Vector3d& there = point ? point->ecef : trajectory->points.front().ecef;
    const double distance_m = (there - ecef_from_geodetic(place)).norm();
    if (distance_m < kLeast_m)
      refuse(problem_, one, "reference", "'" + one.reference + "' is at the station");
    if (distance_m < kGreatest_m) return;
    Geodetic exchanged = geodetic_from_ecef(there);
    std::swap(exchanged.latitude_rad, exchanged.longitude_rad);
    const bool fits =
        (ecef_from_geodetic(exchanged) - ecef_from_geodetic(place)).norm() < kGreatest_m;
    refuse(problem_, one, "reference",
           "'" + one.reference + "' is " + std::to_string(std::lround(1e-3 * distance_m)) +
               " km from the station, more than can be sighted" +
               (fits ? ": are its latitude and longitude exchanged?" : ""));
  }

  void check_pixel(const Observation& one) const {
    const StationModel& model = problem_.stations[one.station].model;
    if (!unproject(model.geometry.camera, one.pixel)) {
      refuse(problem_, one, "x_px", "the pixel is outside of the lens model");
    }
  }

  void add(const std::vector<std::size_t>& members) {
    const Observation& first = problem_.observations[members.front()];
    Group group;
    group.kind = first.kind;
    group.name = first.reference;
    group.station = first.station;
    if (first.kind == Kind::kScene) group.name = problem_.names[first.station];
    if (first.kind == Kind::kInclinometer) {
      add_level(group, members);
    } else if (is_rectification_target(first.kind)) {
      add_rectification(group, members);
    } else if (first.kind == Kind::kScene) {
      add_parts(group, parts(members, [](const Observation& one) { return one.reference; }));
    } else if (first.kind == Kind::kTrack) {
      add_parts(group, parts(members, [](const Observation& one) { return one.utime_us; }));
      if (group.blocks.empty()) {
        refuse(problem_, first, "utime_us", "no instant of the track is seen by two stations");
      }
    } else {
      add_block(group, members);
    }
    if (!group.blocks.empty()) network_.groups.push_back(std::move(group));
  }

  template <class KeyOf>
  std::vector<std::vector<std::size_t>> parts(const std::vector<std::size_t>& members,
                                              const KeyOf& key_of_part) const {
    std::map<decltype(key_of_part(problem_.observations[0])), std::vector<std::size_t>> parts;
    for (const std::size_t i : members) {
      parts[key_of_part(problem_.observations[i])].push_back(i);
    }
    std::vector<std::vector<std::size_t>> result;
    result.reserve(parts.size());
    for (auto& [key, part] : parts) result.push_back(std::move(part));
    return result;
  }

  // A scene point seen once, or an instant of a track that one station alone sees, tells nothing.
  void add_parts(Group& group, const std::vector<std::vector<std::size_t>>& all) {
    for (const auto& part : all) {
      std::set<std::size_t> stations;
      for (const std::size_t i : part) stations.insert(problem_.observations[i].station);
      const bool tells = group.kind == Kind::kScene ? part.size() > 1 : stations.size() > 1;
      if (tells) add_block(group, part);
    }
  }

  void add_block(Group& group, const std::vector<std::size_t>& members) {
    PixelBlockConfig config;
    config.layout = network_.layout;
    config.robust = group.kind == Kind::kScene;
    config.absolute = group.is_absolute();
    std::vector<Sighting> sightings;
    for (const std::size_t i : members) {
      const Observation& one = problem_.observations[i];
      if (one.kind == Kind::kAircraft || one.kind == Kind::kDrone) trajectory_of(problem_, one);
      check_distance(one);
      check_pixel(one);
      sightings.push_back(sighting_of(i));
    }
    const Observation& first = problem_.observations[members.front()];
    const auto planet = planet_seen(problem_, first);
    take(group, members,
         pixel_block(planet ? planet_target(*planet, members) : target_of(first),
                     std::move(sightings), config));
  }

  void add_level(Group& group, const std::vector<std::size_t>& members) {
    group.name = problem_.names[group.station];
    std::vector<Observation> readings;
    readings.reserve(members.size());
    for (const std::size_t i : members) readings.push_back(problem_.observations[i]);
    take(group, members, level_block(network_.layout, std::move(readings)));
  }

  void add_rectification(Group& group, const std::vector<std::size_t>& members) {
    std::vector<TargetSighting> sightings;
    for (const std::size_t i : members) {
      const Observation& one = problem_.observations[i];
      check_pixel(one);
      sightings.push_back({sighting_of(i), one.target, one.reference});
    }
    const PixelBlockConfig config{network_.layout, false, false};
    if (group.kind == Kind::kLevelLine) {
      take(group, members, level_line_block(config, std::move(sightings)));
    } else if (group.kind == Kind::kCross) {
      take(group, members, cross_block(config, std::move(sightings)));
    } else {
      group.name = "rulers";
      check_rulers(members);
      take(group, members, ruler_block(config, std::move(sightings)));
    }
  }

  // The height of the zeros is not known: only the difference of two rulers tells a slope.
  void check_rulers(const std::vector<std::size_t>& members) const {
    constexpr double kApart = 1.2;
    std::map<std::string, const Observation*> rulers;
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
    for (const std::size_t i : members) {
      const Observation& one = problem_.observations[i];
      const Observation& first = *rulers.try_emplace(one.reference, &one).first->second;
      if (first.target.distance_m != one.target.distance_m) {
        refuse(problem_, one, "distance_m", "'" + one.reference + "' has another distance already",
               &first);
      }
      nearest = std::min(nearest, one.target.distance_m);
      farthest = std::max(farthest, one.target.distance_m);
    }
    if (farthest >= kApart * nearest) return;
    refuse(problem_, problem_.observations[members.front()], "distance_m",
           "two rulers are needed, the second at least a fifth farther away than the first");
  }

  void take(Group& group, const std::vector<std::size_t>& members, BlockPtr block) {
    group.degrees_of_freedom += block->degrees_of_freedom();
    group.blocks.push_back(network_.blocks.size());
    group.observations.insert(group.observations.end(), members.begin(), members.end());
    network_.blocks.push_back(std::move(block));
  }

  const Problem& problem_;
  const SharedPoses poses_;
  Network network_;
  std::map<Key, std::vector<std::size_t>> members_;
};

}  // namespace

Network network_of(const Problem& problem) { return Builder(problem).build(); }

Network alone(const Network& network, std::size_t station) {
  Network result = network;
  result.blocks.clear();
  result.groups.clear();
  for (const Group& group : network.groups) {
    Group own = group;
    own.station = station;
    own.blocks.clear();
    own.observations.clear();
    own.degrees_of_freedom = 0;
    for (const std::size_t b : group.blocks) {
      const BlockPtr block = network.blocks[b]->of_station(station);
      if (!block) continue;
      own.degrees_of_freedom += block->degrees_of_freedom();
      own.blocks.push_back(result.blocks.size());
      result.blocks.push_back(block);
    }
    if (!own.blocks.empty()) result.groups.push_back(std::move(own));
  }
  result.priors_from = result.blocks.size();
  result.blocks.insert(result.blocks.end(),
                       network.blocks.begin() + static_cast<std::ptrdiff_t>(network.priors_from),
                       network.blocks.end());
  return result;
}

}  // namespace ols::calibration
