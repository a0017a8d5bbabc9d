#include "edge/config.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <string>
#include <utility>

#include "base/lcm_url.h"
#include "base/toml_config.h"
#include "edge/sensors/pose_keeper_config.h"
#include "geometry/angles.h"

namespace ols {
namespace {

constexpr double kLengthMax_m = 100.0;

double angle(ConfigTable& table, const char* key_deg, double fallback_rad, double limit_deg) {
  return radians(table.number(key_deg, degrees(fallback_rad), -limit_deg, limit_deg));
}

double angle_sd(ConfigTable& table, const char* key_deg, double fallback_rad) {
  return radians(table.number(key_deg, degrees(fallback_rad), 0.0, 90.0));
}

Eigen::Vector3d vector(ConfigTable& table, const char* key, const Eigen::Vector3d& fallback) {
  const auto v =
      table.numbers(key, {fallback.x(), fallback.y(), fallback.z()}, -kLengthMax_m, kLengthMax_m);
  return {v[0], v[1], v[2]};
}

int sign(ConfigTable& table, const char* key, int fallback) {
  const auto value = table.integer(key, fallback, -1, 1);
  if (value == 0) throw table.error(key, "must be 1 or -1");
  return static_cast<int>(value);
}

std::string station_id(ConfigTable& root) {
  std::string id = root.required_text("id");
  bool valid = !id.empty() && id.size() <= 32;
  for (const char c : id) {
    valid = valid && (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_');
  }
  if (!valid) throw root.error("id", "1 to 32 letters, digits, - or _ are wanted");
  return id;
}

Geodetic read_position(ConfigTable& pose) {
  Geodetic position;
  position.latitude_rad = radians(pose.required_number("latitude_deg", -90.0, 90.0));
  position.longitude_rad = radians(pose.required_number("longitude_deg", -180.0, 360.0));
  position.height_m = pose.required_number("height_m", -1000.0, 100000.0);
  return position;
}

// The survey overrides the sensors; what it leaves out is theirs. Without position and receiver the
// position is asked for, without tilt and inclinometer the head is taken as level, roughly: unless
// [calibration.sd] says how well it was levelled.
void read_pose(ConfigTable& pose, ConfigTable& calibration_sd, StationSettings& settings) {
  StationGeometry& geometry = settings.station.geometry;
  PoseKeeper::Config& keeper = settings.pose;
  geometry.chain.heading_rad = radians(pose.required_number("heading_deg", -360.0, 360.0));
  const bool any = pose.has("latitude_deg") || pose.has("longitude_deg") || pose.has("height_m");
  if (any || settings.gnss.host.empty()) {
    keeper.surveyed_position = geometry.position = read_position(pose);
    keeper.surveyed_position_sd_m = geometry.sd.position_m;
  }
  const bool levelled = settings.inclinometer.device.empty() && calibration_sd.has("tilt_deg");
  if (pose.has("tilt_x_deg") || pose.has("tilt_y_deg") || levelled) {
    geometry.chain.tilt_x_rad = angle(pose, "tilt_x_deg", 0.0, 45.0);
    geometry.chain.tilt_y_rad = angle(pose, "tilt_y_deg", 0.0, 45.0);
    keeper.surveyed_tilt_rad =
        Eigen::Vector2d(geometry.chain.tilt_x_rad, geometry.chain.tilt_y_rad);
    keeper.surveyed_tilt_sd_rad = geometry.sd.tilt_rad;
  }
  keeper.level_sd_rad = angle_sd(pose, "level_sd_deg", keeper.level_sd_rad);
  keeper.alarm_sigma = pose.number("alarm_sigma", keeper.alarm_sigma, 1.0, 100.0);
  keeper.growth_m_sqrt_s = pose.number("growth_m_sqrt_s", keeper.growth_m_sqrt_s, 0.0, 10.0);
  keeper.growth_rad_sqrt_s = angle_sd(pose, "growth_deg_sqrt_s", keeper.growth_rad_sqrt_s);
}

void read_chain(ConfigTable& table, ChainParameters& chain) {
  chain.ground_to_origin_m = vector(table, "ground_to_origin_m", chain.ground_to_origin_m);
  chain.origin_to_azi_m = vector(table, "origin_to_azi_m", chain.origin_to_azi_m);
  chain.azi_to_ele_m = vector(table, "azi_to_ele_m", chain.azi_to_ele_m);
  chain.ele_to_focus_m = vector(table, "ele_to_focus_m", chain.ele_to_focus_m);
  chain.focus_to_camera_m = vector(table, "focus_to_camera_m", chain.focus_to_camera_m);
  chain.mount_z_rad = angle(table, "mount_z_deg", chain.mount_z_rad, 180.0);
  chain.mount_x_rad = angle(table, "mount_x_deg", chain.mount_x_rad, 180.0);
  chain.mount_y_rad = angle(table, "mount_y_deg", chain.mount_y_rad, 180.0);
  chain.pan_sign = sign(table, "pan_sign", chain.pan_sign);
  chain.tilt_sign = sign(table, "tilt_sign", chain.tilt_sign);
  chain.pan_zero_rad = angle(table, "pan_zero_deg", chain.pan_zero_rad, 360.0);
  chain.tilt_zero_rad = angle(table, "tilt_zero_deg", chain.tilt_zero_rad, 360.0);
}

void read_lens(ConfigTable& lens, CameraIntrinsics& camera) {
  camera.fx_px = lens.required_number("fx_px", 1.0, 1e7);
  camera.fy_px = lens.required_number("fy_px", 1.0, 1e7);
  camera.cx_px = lens.number("cx_px", (camera.width_px - 1) / 2.0, -1e5, 1e5);
  camera.cy_px = lens.number("cy_px", (camera.height_px - 1) / 2.0, -1e5, 1e5);
  camera.skew = lens.number("skew", camera.skew, -1e5, 1e5);
  camera.k1 = lens.number("k1", camera.k1, -1e3, 1e3);
  camera.k2 = lens.number("k2", camera.k2, -1e6, 1e6);
  camera.p1 = lens.number("p1", camera.p1, -1e3, 1e3);
  camera.p2 = lens.number("p2", camera.p2, -1e3, 1e3);
  camera.k3 = lens.number("k3", camera.k3, -1e9, 1e9);
}

// How well the heading and the camera's mounting are known nobody but a person can tell, and a zero
// that nobody meant would make every position overconfident.
void read_calibration_sd(ConfigTable& table, CalibrationSd& sd) {
  sd.heading_rad = radians(table.required_number("heading_deg", 0.0, 90.0));
  sd.tilt_rad = angle_sd(table, "tilt_deg", sd.tilt_rad);
  sd.mount_rad = radians(table.required_number("mount_deg", 0.0, 90.0));
  sd.mount_roll_rad = angle_sd(table, "mount_roll_deg", sd.mount_roll_rad);
  sd.position_m = table.number("position_m", sd.position_m, 0.0, 1e5);
}

void read_clock(ConfigTable& table, StationSettings& settings) {
  ClockWatch::Config& clock = settings.clock;
  clock.assumed_sd_s = table.number("sd_s", clock.assumed_sd_s, 0.0, 1e4);
  clock.never_set_sd_s = table.number("never_set_sd_s", clock.never_set_sd_s, 0.0, 1e4);
  clock.step_s = table.number("step_s", clock.step_s, 1e-3, 10.0);
  clock.distrust_s = table.number("distrust_s", clock.distrust_s, 0.0, 1e5);
  clock.drift_per_s = table.number("drift_per_s", clock.drift_per_s, 0.0, 1e-2);
  clock.silence_s = table.number("silence_s", clock.silence_s, 1.0, 1e5);
  settings.clock_interval_s = table.number("interval_s", settings.clock_interval_s, 0.1, 600.0);
}

void read_watchdog(ConfigTable& table, StationSettings& settings) {
  HostConfig& host = settings.host;
  if (!settings.recorder.folder.empty()) host.disk_folder = settings.recorder.folder;
  host.disk_folder = table.text("disk_folder", host.disk_folder);
  host.disk_alarm_bytes = table.number("disk_alarm_bytes", host.disk_alarm_bytes, 0.0, 1e15);
  host.cpu_alarm_degC = table.number("cpu_alarm_degC", host.cpu_alarm_degC, 0.0, 200.0);
  host.slow_turn_s = table.number("slow_turn_s", host.slow_turn_s, 0.01, 60.0);
}

void read_devices(ConfigTable& root, StationSettings& settings) {
  settings.camera = read_camera_config(root.table("camera"));
  settings.ptu = read_ptu_config(root.table("ptu"));
  settings.inclinometer = read_inclinometer_config(root.table("inclinometer"));
  settings.gnss = read_gnss_config(root.table("gnss"));
  settings.gpio = read_gpio_config(root.table("gpio"));
  settings.recorder = read_recorder_config(root.table("recorder"));
  settings.camera.keep_raw = !settings.recorder.folder.empty();
  settings.pose = pose_keeper_config(settings.inclinometer, settings.gnss);
  // An empty text says that there is none; a section that leaves it out is a mistake.
  for (const auto& [name, key] : {std::pair("inclinometer", "device"),
                                  {"gnss", "host"},
                                  {"gpio", "chip"},
                                  {"recorder", "folder"}}) {
    if (root.has(name) && !root.table(name).has(key))
      throw root.error(name, "lacks its " + std::string(key));
  }
}

// A search is as wide as the doubt of the direction, between this and a part of the picture.
void read_search_sd(ConfigTable& table, StationConfig& station) {
  const double most_px = station.search_sd_most_px();
  station.search_sd_px =
      table.number("search_sd_px", std::min(station.search_sd_px, most_px), 1.0, 1000.0);
  if (station.search_sd_px <= most_px) return;
  char text[80];
  std::snprintf(text, sizeof text, "is more than a quarter of the picture's width (%g px)",
                most_px);
  throw table.error("search_sd_px", text);
}

void read_logic(ConfigTable& table, StationConfig& station) {
  station.designation_sd_px =
      table.number("designation_sd_px", station.designation_sd_px, 0.0, 100.0);
  station.tracking_belief = table.number("tracking_belief", station.tracking_belief, 0.0, 1.0);
  station.coast_s = table.number("coast_s", station.coast_s, 0.0, 60.0);
  station.reacquire_frames =
      static_cast<int>(table.integer("reacquire_frames", station.reacquire_frames, 1, 100));
  station.angle_wait_s = table.number("angle_wait_s", station.angle_wait_s, 0.0, 1.0);
  station.frame_memory_s = table.number("frame_memory_s", station.frame_memory_s, 0.0, 10.0);
  station.search_interval_s =
      table.number("search_interval_s", station.search_interval_s, 0.0, 60.0);
  read_search_sd(table, station);
  station.acquire_by_slew = table.boolean("acquire_by_slew", station.acquire_by_slew);
  station.own_target_s = table.number("own_target_s", station.own_target_s, 0.0, 3600.0);
  station.unacquired_alarm_s =
      table.number("unacquired_alarm_s", station.unacquired_alarm_s, 1.0, 3600.0);
  station.acquisition_sd_px =
      table.number("acquisition_sd_px", station.acquisition_sd_px, 0.0, 100.0);
  station.prediction_error_px =
      table.number("prediction_error_px", station.prediction_error_px, 1.0, 10000.0);
  station.disagreeing_frames =
      static_cast<int>(table.integer("disagreeing_frames", station.disagreeing_frames, 1, 1000));
  station.acquisition.frames =
      static_cast<int>(table.integer("acquisition_frames", station.acquisition.frames, 2, 100));
  station.slew_lease_max_s = table.number("slew_lease_max_s", station.slew_lease_max_s, 0.1, 5.0);
  station.point_time_s = table.number("point_time_s", station.point_time_s, 0.1, 60.0);
  station.max_age_s = table.number("max_age_s", station.max_age_s, 0.1, 10.0);
  station.motion.acceleration_sd_rad_s2 =
      angle_sd(table, "target_acceleration_deg_s2", station.motion.acceleration_sd_rad_s2);
}

}  // namespace

StationSettings load_station_settings(const std::string& path) {
  ConfigFile file(path);
  ConfigTable& root = file.root();
  StationSettings settings;
  settings.id = station_id(root);
  settings.lcm_url = read_lcm_url(root, "lcm_url", settings.lcm_url);
  settings.state_folder = root.text("state_folder", settings.state_folder);
  settings.tracker_seed = static_cast<std::uint64_t>(root.integer("tracker_seed", 1, 0, INT64_MAX));
  settings.status_interval_s =
      root.number("status_interval_s", settings.status_interval_s, 0.05, 60.0);
  settings.preview_interval_s =
      root.number("preview_interval_s", settings.preview_interval_s, 0.0, 60.0);

  StationGeometry& geometry = settings.station.geometry;
  read_devices(root, settings);
  settings.tracker = read_tracker_config(root.table("tracker"));
  geometry.camera.width_px = settings.camera.width_px;
  geometry.camera.height_px = settings.camera.height_px;
  read_chain(root.table("chain"), geometry.chain);
  read_lens(root.table("lens"), geometry.camera);

  ConfigTable& calibration = root.table("calibration");
  settings.calibration_id = calibration.integer("id", 0, 0, INT64_MAX);
  read_calibration_sd(calibration.table("sd"), geometry.sd);
  read_pose(root.table("pose"), calibration.table("sd"), settings);
  read_clock(root.table("clock"), settings);
  read_watchdog(root.table("watchdog"), settings);
  read_logic(root.table("logic"), settings.station);
  settings.station.angles = settings.ptu.history;
  settings.station.limits = settings.ptu.limits;
  settings.station.homing_allowed =
      settings.ptu.limits.keep_out.empty() || settings.ptu.home_despite_keep_out;
  settings.station.rearm_over_bus = settings.gpio.rearm_over_bus;
  file.finish();
  return settings;
}

}  // namespace ols
