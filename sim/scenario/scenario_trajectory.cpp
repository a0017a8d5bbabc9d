#include "sim/scenario/scenario_trajectory.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "edge/config/config_units.h"
#include "sim/scenario/scenario_places.h"
#include "sim/world/trajectory_file.h"

namespace ols::sim {
namespace {

using config::Section;
using Eigen::Vector3d;

constexpr config::Range kSite_m{-kFar_m, kFar_m};

// The keys of all kinds; each kind uses some.
struct TrajectoryKeys {
  std::string kind = "lissajous";
  Vector3d centre_enu_m = Vector3d::Zero(), amplitude_m = Vector3d::Zero();
  Vector3d period_s = Vector3d::Constant(60.0), phase_rad = Vector3d::Zero();
  Vector3d start_enu_m = Vector3d::Zero(), velocity_enu_m_s = Vector3d::Zero();
  double radius_m = 0.0, speed_m_s = 0.0;
  std::vector<Vector3d> waypoints;
  std::string file;
  UtmPlace utm;
};

struct TrajectoryKind {
  const char* name;
  std::vector<std::string> required, optional;
};

const std::vector<TrajectoryKind>& kinds() {
  static const std::vector<TrajectoryKind> all{
      {"lissajous", {}, {"centre_enu_m", "amplitude_m", "period_s", "phase_deg"}},
      {"circle", {"radius_m", "speed_m_s"}, {"centre_enu_m"}},
      {"line", {}, {"start_enu_m", "velocity_enu_m_s"}},
      {"waypoints", {"speed_m_s"}, {"waypoint"}},
      {"file", {"file"}, {}},
      {"utm", {"easting_m", "northing_m", "height_m"}, {"zone", "hemisphere"}}};
  return all;
}

void check_keys(ConfigTable& table, const std::string& name) {
  const TrajectoryKind& kind = *std::ranges::find(kinds(), name, &TrajectoryKind::name);
  std::vector<std::string> known{"kind"};
  known.insert(known.end(), kind.required.begin(), kind.required.end());
  known.insert(known.end(), kind.optional.begin(), kind.optional.end());
  table.refuse_unknown(known);
  for (const std::string& key : kind.required)
    if (!table.has(key)) throw table.error(key, "is missing");
}

std::unique_ptr<Trajectory> circle(const TrajectoryKeys& keys) {
  auto path = std::make_unique<Lissajous>();
  path->centre_enu = keys.centre_enu_m;
  path->amplitude_m = {keys.radius_m, keys.radius_m, 0.0};
  path->period_s.setConstant(2.0 * kPi * keys.radius_m / keys.speed_m_s);
  path->phase_rad = {0.5 * kPi, 0.0, 0.0};
  return path;
}

std::unique_ptr<Trajectory> lissajous(const TrajectoryKeys& keys) {
  auto path = std::make_unique<Lissajous>();
  path->centre_enu = keys.centre_enu_m;
  path->amplitude_m = keys.amplitude_m;
  path->period_s = keys.period_s;
  path->phase_rad = keys.phase_rad;
  return path;
}

std::unique_ptr<Trajectory> line(const Vector3d& start_enu, const Vector3d& v_enu) {
  auto path = std::make_unique<Line>();
  path->start_enu = start_enu;
  path->v_enu = v_enu;
  return path;
}

std::unique_ptr<Trajectory> waypoints(ConfigTable& table, const TrajectoryKeys& keys) {
  try {
    return through_waypoints(keys.waypoints, keys.speed_m_s);
  } catch (const std::invalid_argument& problem) {
    throw table.error("waypoint", problem.what());
  }
}

std::unique_ptr<Trajectory> made(ConfigTable& table, const TrajectoryKeys& keys,
                                 const TrajectoryPlace& place) {
  check_keys(table, keys.kind);
  const LocalFrame site(place.origin);
  if (keys.kind == "lissajous") return lissajous(keys);
  if (keys.kind == "circle") return circle(keys);
  if (keys.kind == "waypoints") return waypoints(table, keys);
  if (keys.kind == "utm")  // a landmark as in a land register: it is stationary
    return line(site.to_enu(ecef_from_geodetic(geodetic(table, keys.utm))), Vector3d::Zero());
  if (keys.kind == "file")
    return load_trajectory_file(
        keys.file.starts_with('/') ? keys.file : place.folder + "/" + keys.file, site);
  return line(keys.start_enu_m, keys.velocity_enu_m_s);
}

Section waypoint_section(std::vector<Vector3d>& points) {
  Section section{"waypoint", "A point of a trajectory through waypoints."};
  section.append = [&points] {
    Vector3d& point = points.emplace_back(Vector3d::Zero());
    return Section{"",
                   "",
                   {config::numbers("enu_m", {point.data(), 3}, kSite_m, "m",
                                    "East, north, up from the site's origin.")}};
  };
  return section;
}

std::vector<config::Row> rows(TrajectoryKeys& keys) {
  std::vector<std::string> names;
  for (const TrajectoryKind& kind : kinds()) names.emplace_back(kind.name);
  std::vector<config::Row> result{
      config::choice("kind", keys.kind, names, "Each kind has keys of its own."),
      config::numbers("centre_enu_m", {keys.centre_enu_m.data(), 3}, kSite_m, "m",
                      "lissajous, circle: the centre: east, north, up."),
      config::numbers("amplitude_m", {keys.amplitude_m.data(), 3}, {0.0, kFar_m}, "m",
                      "lissajous: of each axis."),
      config::numbers("period_s", {keys.period_s.data(), 3}, {0.1, 1e6}, "s",
                      "lissajous: of each axis."),
      config::numbers("phase_deg", {keys.phase_rad.data(), 3}, {-360.0, 360.0},
                      station::in_degrees(), "lissajous: of each axis."),
      config::number("radius_m", keys.radius_m, {0.1, kFar_m}, "m", "circle: its radius.")
          .default_is("required"),
      config::number("speed_m_s", keys.speed_m_s, {0.01, 1000.0}, "m/s",
                     "circle, waypoints: the mean speed.")
          .default_is("required"),
      config::numbers("start_enu_m", {keys.start_enu_m.data(), 3}, kSite_m, "m",
                      "line: position at the start."),
      config::numbers("velocity_enu_m_s", {keys.velocity_enu_m_s.data(), 3}, {-1000.0, 1000.0},
                      "m/s", "line: velocity."),
      config::text("file", keys.file, "file: a CSV file with times and positions.")
          .default_is("required")};
  for (config::Row& row : utm_rows(keys.utm)) {
    row.sentence = "utm: " + row.sentence;
    result.push_back(std::move(row));
  }
  return result;
}

}  // namespace

Section trajectory_section(std::shared_ptr<const Trajectory>& trajectory,
                           const TrajectoryPlace& place) {
  auto keys = std::make_shared<TrajectoryKeys>();
  return {
      "trajectory",
      "How the target moves.",
      rows(*keys),
      {waypoint_section(keys->waypoints)},
      [keys, &trajectory, place](ConfigTable& table) { trajectory = made(table, *keys, place); }};
}

}  // namespace ols::sim
