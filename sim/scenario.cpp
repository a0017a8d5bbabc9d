#include "sim/scenario.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "base/toml_config.h"
#include "sim/scenario_places.h"
#include "sim/trajectory_file.h"

namespace ols::sim {
namespace {

using Eigen::Vector3d;

constexpr double kFar = 1e6;  // [m] a site is no larger than this

Vector3d vector3(ConfigTable& table, std::string_view key, const Vector3d& fallback, double least,
                 double greatest) {
  const auto v = table.numbers(key, {fallback.x(), fallback.y(), fallback.z()}, least, greatest);
  return {v[0], v[1], v[2]};
}

double degrees_of(ConfigTable& table, std::string_view key, double fallback_rad, double least,
                  double greatest) {
  return radians(table.number(key, degrees(fallback_rad), least, greatest));
}

void read_site(ConfigTable& table, Scenario& s) {
  s.origin.latitude_rad = radians(table.required_number("latitude_deg", -90, 90));
  s.origin.longitude_rad = radians(table.required_number("longitude_deg", -180, 180));
  s.origin.height_m = table.required_number("height_m", -1000, 9000);
}

void read_camera(ConfigTable& table, Scenario& s) {
  CameraIntrinsics& c = s.camera;
  c.width_px = static_cast<int>(table.integer("width_px", c.width_px, 64, 2048));
  c.height_px = static_cast<int>(table.integer("height_px", c.height_px, 64, 2048));
  const double focal_mm = table.number("focal_length_mm", 50.0, 4.0, 1000.0);
  const double pitch_um = table.number("pixel_um", 3.75, 1.0, 20.0);
  c.fx_px = c.fy_px = focal_mm * 1e3 / pitch_um;
  c.cx_px = table.number("cx_px", 0.5 * (c.width_px - 1), 0, c.width_px);
  c.cy_px = table.number("cy_px", 0.5 * (c.height_px - 1), 0, c.height_px);
  const auto d = table.numbers("distortion", {0, 0, 0, 0, 0}, -10, 10);
  c.k1 = d[0], c.k2 = d[1], c.p1 = d[2], c.p2 = d[3], c.k3 = d[4];
  s.frame_rate_hz = table.number("frame_rate_hz", s.frame_rate_hz, 1, 60);
  s.exposure_s = 1e-3 * table.number("exposure_ms", 1e3 * s.exposure_s, 0.01, 100);
  s.readout_s = 1e-3 * table.number("readout_ms", 1e3 * s.readout_s, 0, 100);
}

void read_ptu(ConfigTable& table, PtuScenario& p) {
  p.baud = static_cast<int>(table.integer("baud", p.baud, 600, 115200));
  p.poll_interval_s = 1e-3 * table.number("poll_interval_ms", 1e3 * p.poll_interval_s, 5, 1000);
  p.home_at_power_up = table.boolean("home_at_power_up", p.home_at_power_up);
}

void read_inclinometer(ConfigTable& table, InclinometerScenario& i) {
  i.on = table.boolean("on", i.on);
  i.zero_sd_rad = degrees_of(table, "zero_sd_deg", i.zero_sd_rad, 0, 5);
  i.noise_sd_rad = degrees_of(table, "noise_sd_deg", i.noise_sd_rad, 0, 5);
}

void read_gnss(ConfigTable& table, GnssScenario& g) {
  g.on = table.boolean("on", g.on);
  g.sd_m = table.number("sd_m", g.sd_m, 1e-3, 100);
  g.ground_to_antenna_enu_m =
      vector3(table, "ground_to_antenna_enu_m", g.ground_to_antenna_enu_m, -100, 100);
  g.gpsd_port = static_cast<int>(table.integer("gpsd_port", g.gpsd_port, 1024, 65000));
}

void read_landscape(ConfigTable& table, Landscape& l) {
  l.ridge_mean_rad = degrees_of(table, "ridge_mean_deg", l.ridge_mean_rad, -10, 40);
  l.ridge_relief_rad = degrees_of(table, "ridge_relief_deg", l.ridge_relief_rad, 0, 30);
  l.cloudiness = table.number("cloudiness", l.cloudiness, 0, 2);
  l.haze = table.number("haze", l.haze, 0, 1);
  l.seed = static_cast<int>(table.integer("seed", l.seed, 0, 1 << 30));
}

// A table of the errors with its switch read.
ConfigTable& error_table(ConfigTable& errors, std::string_view key, Errors::Switch& error) {
  ConfigTable& table = errors.table(key);
  error.on = table.boolean("on", error.on);
  return table;
}

void read_pose_errors(ConfigTable& table, Errors& e) {
  ConfigTable& heading = error_table(table, "heading", e.heading);
  e.heading.sd_rad = degrees_of(heading, "sd_deg", e.heading.sd_rad, 0, 5);
  ConfigTable& tilt = error_table(table, "tilt", e.tilt);
  e.tilt.sd_rad = degrees_of(tilt, "sd_deg", e.tilt.sd_rad, 0, 5);
  ConfigTable& mounting = error_table(table, "mounting", e.mounting);
  e.mounting.sd_rad = degrees_of(mounting, "sd_deg", e.mounting.sd_rad, 0, 5);
  e.mounting.roll_sd_rad = degrees_of(mounting, "roll_sd_deg", e.mounting.roll_sd_rad, 0, 5);
  ConfigTable& position = error_table(table, "position", e.position);
  e.position.sd_m = position.number("sd_m", e.position.sd_m, 0, 100);
}

void read_image_errors(ConfigTable& table, Errors& e) {
  ConfigTable& distortion = error_table(table, "distortion", e.distortion);
  e.distortion.residual_k1_sd =
      distortion.number("residual_k1_sd", e.distortion.residual_k1_sd, 0, 10);
  ConfigTable& noise = error_table(table, "noise", e.noise);
  e.noise.sd_gray = noise.number("sd_gray", e.noise.sd_gray, 0, 30);
  error_table(table, "motion_blur", e.motion_blur);
  ConfigTable& brightness = error_table(table, "brightness", e.brightness);
  e.brightness.vignetting = brightness.number("vignetting", e.brightness.vignetting, 0, 0.9);
  e.brightness.gain_sd = brightness.number("gain_sd", e.brightness.gain_sd, 0, 0.3);
}

void read_device_errors(ConfigTable& table, Errors& e) {
  ConfigTable& encoder = error_table(table, "encoder", e.encoder);
  e.encoder.step_arcsec = encoder.number("step_arcsec", e.encoder.step_arcsec, 0.1, 1000);
  ConfigTable& clock = error_table(table, "clock", e.clock);
  e.clock.sd_s = 1e-3 * clock.number("sd_ms", 1e3 * e.clock.sd_s, 0, 1e4);
  ConfigTable& reply = error_table(table, "ptu_reply", e.ptu_reply);
  e.ptu_reply.jitter_s = 1e-3 * reply.number("jitter_ms", 1e3 * e.ptu_reply.jitter_s, 0, 100);
  ConfigTable& messages = error_table(table, "messages", e.messages);
  e.messages.lost = messages.number("lost", e.messages.lost, 0, 1);
  e.messages.doubled = messages.number("doubled", e.messages.doubled, 0, 1);
  e.messages.late = messages.number("late", e.messages.late, 0, 1);
  e.messages.delay_s = 1e-3 * messages.number("delay_ms", 1e3 * e.messages.delay_s, 0, 1e4);
  e.messages.late_s = 1e-3 * messages.number("late_ms", 1e3 * e.messages.late_s, 0, 1e5);
  ConfigTable& frames = error_table(table, "frames", e.frames);
  e.frames.lost = frames.number("lost", e.frames.lost, 0, 1);
}

void read_chain(ConfigTable& table, ChainParameters& c) {
  c.heading_rad = degrees_of(table, "heading_deg", 0.0, -360, 360);
  const auto tilt = table.numbers("tilt_xy_deg", {0, 0}, -10, 10);
  c.tilt_x_rad = radians(tilt[0]), c.tilt_y_rad = radians(tilt[1]);
  const Vector3d mount = vector3(table, "mount_zxy_deg", Vector3d::Zero(), -45, 45);
  c.mount_z_rad = radians(mount[0]);
  c.mount_x_rad = radians(mount[1]);
  c.mount_y_rad = radians(mount[2]);
}

StationScenario read_station(ConfigTable& table) {
  StationScenario s;
  s.id = table.required_text("id");
  if (s.id.empty() || s.id.find_first_of("/ ") != std::string::npos) {
    throw table.error("id", "must be a word");
  }
  s.p_enu = vector3(table, "position_enu_m", Vector3d::Zero(), -kFar, kFar);
  read_chain(table, s.chain);
  s.camera_address = table.required_text("camera_address");
  s.ptu_line = table.text("ptu_line", s.id + ".ptu");
  s.ptu_device = table.text("ptu_device", "");
  return s;
}

std::unique_ptr<Trajectory> read_lissajous(ConfigTable& table) {
  auto path = std::make_unique<Lissajous>();
  path->centre_enu = vector3(table, "centre_enu_m", Vector3d::Zero(), -kFar, kFar);
  path->amplitude_m = vector3(table, "amplitude_m", Vector3d::Zero(), 0, kFar);
  path->period_s = vector3(table, "period_s", Vector3d::Constant(60.0), 0.1, 1e6);
  path->phase_rad = vector3(table, "phase_deg", Vector3d::Zero(), -360, 360) * radians(1.0);
  return path;
}

std::unique_ptr<Trajectory> read_circle(ConfigTable& table) {
  auto path = std::make_unique<Lissajous>();
  path->centre_enu = vector3(table, "centre_enu_m", Vector3d::Zero(), -kFar, kFar);
  const double radius_m = table.required_number("radius_m", 0.1, kFar);
  const double speed_m_s = table.required_number("speed_m_s", 0.01, 1000);
  path->amplitude_m = {radius_m, radius_m, 0.0};
  path->period_s.setConstant(2.0 * kPi * radius_m / speed_m_s);
  path->phase_rad = {0.5 * kPi, 0.0, 0.0};
  return path;
}

std::unique_ptr<Trajectory> read_waypoints(ConfigTable& table) {
  std::vector<Vector3d> points;
  for (ConfigTable* point : table.tables("waypoint")) {
    points.push_back(vector3(*point, "enu_m", Vector3d::Zero(), -kFar, kFar));
  }
  const double speed_m_s = table.required_number("speed_m_s", 0.01, 1000);
  try {
    return through_waypoints(points, speed_m_s);
  } catch (const std::invalid_argument& problem) {
    throw table.error("waypoint", problem.what());
  }
}

// A landmark as a land register has it: it stands still.
std::unique_ptr<Trajectory> read_utm(ConfigTable& table, const LocalFrame& site) {
  auto path = std::make_unique<Line>();
  path->start_enu = site.to_enu(ecef_from_geodetic(read_utm_place(table)));
  return path;
}

std::unique_ptr<Trajectory> read_trajectory(ConfigTable& table, const LocalFrame& site,
                                            const std::string& folder) {
  const std::string kind = table.choice(
      "kind", "lissajous", {"lissajous", "circle", "line", "waypoints", "file", "utm"});
  if (kind == "lissajous") return read_lissajous(table);
  if (kind == "circle") return read_circle(table);
  if (kind == "waypoints") return read_waypoints(table);
  if (kind == "utm") return read_utm(table, site);
  if (kind == "file") {
    const std::string name = table.required_text("file");
    return load_trajectory_file(name.starts_with('/') ? name : folder + "/" + name, site);
  }
  auto path = std::make_unique<Line>();
  path->start_enu = vector3(table, "start_enu_m", Vector3d::Zero(), -kFar, kFar);
  path->v_enu = vector3(table, "velocity_enu_m_s", Vector3d::Zero(), -1000, 1000);
  return path;
}

TargetScenario read_target(ConfigTable& table, const LocalFrame& site, const std::string& folder) {
  TargetScenario t;
  t.id = table.text("id", "");
  t.span_m = table.number("span_m", t.span_m, 0.05, 100);
  t.brightness = table.number("brightness", t.brightness, 0, 2);
  t.trajectory = read_trajectory(table.table("trajectory"), site, folder);
  return t;
}

void read_stations(ConfigTable& root, Scenario& s) {
  std::set<std::string> ids;
  for (ConfigTable* table : root.tables("station")) {
    s.stations.push_back(read_station(*table));
    if (!ids.insert(s.stations.back().id).second) {
      throw table->error("id", "is used by two stations");
    }
  }
  if (s.stations.empty()) throw root.error("station", "at least one is needed");
}

Fault read_fault(ConfigTable& table, const std::vector<StationScenario>& stations) {
  Fault f;
  f.kind = table.required_text("kind");
  f.station = table.text("station", "");
  f.at_s = table.required_number("at_s", 0.0, 1e9);
  if (table.has("for_s")) f.for_s = table.required_number("for_s", 0.0, 1e9);
  if (table.has("value")) f.value = table.required_number("value", -1e9, 1e9);
  const FaultProblem problem = check(f);
  if (!problem.key.empty()) throw table.error(problem.key, problem.what);
  const bool known = std::any_of(stations.begin(), stations.end(),
                                 [&f](const StationScenario& s) { return s.id == f.station; });
  if (!f.station.empty() && !known) throw table.error("station", "there is none of this id");
  return f;
}

Scenario read_scenario(ConfigFile& file, const std::string& folder) {
  ConfigTable& root = file.root();
  Scenario s;
  s.name = root.required_text("name");
  read_site(root.table("site"), s);
  read_camera(root.table("camera"), s);
  read_ptu(root.table("ptu"), s.ptu);
  read_inclinometer(root.table("inclinometer"), s.inclinometer);
  read_gnss(root.table("gnss"), s.gnss);
  s.gpio.on = root.table("gpio").boolean("on", s.gpio.on);
  read_landscape(root.table("landscape"), s.landscape);
  ConfigTable& errors = root.table("errors");
  read_pose_errors(errors, s.errors);
  read_image_errors(errors, s.errors);
  read_device_errors(errors, s.errors);
  s.stationing = read_stationing(root.table("stationing"));
  read_stations(root, s);
  const LocalFrame site(s.origin);
  std::set<std::string> ids;
  for (ConfigTable* table : root.tables("target")) {
    TargetScenario& target = s.targets.emplace_back(read_target(*table, site, folder));
    if (target.id.empty()) target.id = std::to_string(s.targets.size());
    if (!ids.insert(target.id).second) throw table->error("id", "is used by two targets");
  }
  if (s.targets.empty()) throw root.error("target", "at least one is needed");
  for (ConfigTable* table : root.tables("fault")) {
    s.faults.push_back(read_fault(*table, s.stations));
  }
  file.finish();
  return s;
}

}  // namespace

void switch_off(Errors& e, const std::string& name) {
  const std::pair<const char*, Errors::Switch*> switches[] = {
      {"heading", &e.heading},       {"tilt", &e.tilt},
      {"mounting", &e.mounting},     {"position", &e.position},
      {"encoder", &e.encoder},       {"distortion", &e.distortion},
      {"noise", &e.noise},           {"motion_blur", &e.motion_blur},
      {"brightness", &e.brightness}, {"clock", &e.clock},
      {"ptu_reply", &e.ptu_reply},   {"messages", &e.messages},
      {"frames", &e.frames}};
  std::string known;
  for (const auto& [known_name, error] : switches) {
    if (name == known_name) {
      error->on = false;
      return;
    }
    known += std::string(known.empty() ? "" : ", ") + known_name;
  }
  throw std::invalid_argument("there is no error '" + name + "'; there are " + known);
}

void keep_target(Scenario& scenario, const std::string& id) {
  const auto found = std::ranges::find(scenario.targets, id, &TargetScenario::id);
  if (found == scenario.targets.end()) {
    throw std::invalid_argument(scenario.name + " has no target '" + id + "'");
  }
  scenario.targets = {*found};
}

Scenario load_scenario(const std::string& path) {
  ConfigFile file(path);
  const std::size_t slash = path.rfind('/');
  return read_scenario(file, slash == std::string::npos ? "." : path.substr(0, slash));
}

Scenario parse_scenario(const std::string& text, const std::string& name,
                        const std::string& folder) {
  ConfigFile file(text, name);
  return read_scenario(file, folder);
}

}  // namespace ols::sim
