#include "sim/scenario/station_files.h"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <sstream>

#include "base/config/toml_text.h"
#include "base/files/atomic_file.h"
#include "edge/calibration/calibration_folder.h"
#include "edge/station/persisted_station_state.h"
#include "sim/gpio/gpio_socket.h"
#include "sim/onvif/ptz_scale.h"
#include "sim/scenario/onvif_camera.h"
#include "sim/world/calibration_round.h"

namespace ols::sim {
namespace {

constexpr double kEncoder_s = 0.05;  // what drawing and encoding a picture takes

void write_pose(std::ostream& out, const StationGeometry& g) {
  out << "\n[pose]"
      << "\nlatitude_deg = " << degrees(g.position.latitude_rad)
      << "\nlongitude_deg = " << degrees(g.position.longitude_rad)
      << "\nheight_m = " << g.position.height_m
      << "\nheading_deg = " << degrees(g.chain.heading_rad)
      << "\ntilt_x_deg = " << degrees(g.chain.tilt_x_rad)
      << "\ntilt_y_deg = " << degrees(g.chain.tilt_y_rad) << "\n";
}

void write_chain(std::ostream& out, const ChainParameters& c) {
  out << "\n[chain]"
      << "\nmount_z_deg = " << degrees(c.mount_z_rad)
      << "\nmount_x_deg = " << degrees(c.mount_x_rad)
      << "\nmount_y_deg = " << degrees(c.mount_y_rad) << "\n";
}

void write_lens(std::ostream& out, const CameraIntrinsics& c) {
  out << "\n[lens]"
      << "\nmodel = " << toml_text(kLensModelNames.at(static_cast<std::size_t>(c.model)))
      << "\nfx_px = " << c.fx_px << "\nfy_px = " << c.fy_px << "\ncx_px = " << c.cx_px
      << "\ncy_px = " << c.cy_px << "\nk1 = " << c.k1 << "\nk2 = " << c.k2 << "\np1 = " << c.p1
      << "\np2 = " << c.p2 << "\nk3 = " << c.k3 << "\nk4 = " << c.k4 << "\n";
}

void write_lens_motor(std::ostream& out, const StationTruth& station,
                      const std::string& line_stem) {
  if (!station.zoom) return;
  out << "\n[lens_motor]"
      << "\ndevice = " << toml_text(line_stem + ".lens") << "\n";
  for (const ZoomPoint& point : station.zoom_points) {
    out << "\n[[lens_motor.point]]"
        << "\nposition = " << point.position << "\nfocal_px = " << point.camera.fx_px
        << "\nfocal_sd_px = " << point.focal_sd_px << "\ncx_px = " << point.camera.cx_px
        << "\ncy_px = " << point.camera.cy_px << "\ncentre_sd_px = " << point.centre_sd_px << "\n";
  }
}

void write_sd(std::ostream& out, const World& world, const CalibrationSd& sd) {
  out << "\n[calibration]"
      << "\nid = " << world.seed() % 1'000'000'007 << "\n\n[calibration.sd]"
      << "\nheading_deg = " << degrees(sd.heading_rad) << "\ntilt_deg = " << degrees(sd.tilt_rad)
      << "\nmount_deg = " << degrees(sd.mount_rad)
      << "\nmount_roll_deg = " << degrees(sd.mount_roll_rad) << "\nposition_m = " << sd.position_m
      << "\n";
}

// Of an ONVIF camera, for its motors and for its video.
void write_login(std::ostream& out, const OnvifConfig& c, const std::string& password_file) {
  out << "\nuser = " << toml_text(c.user) << "\npassword_file = " << toml_text(password_file);
}

void write_camera(std::ostream& out, const Scenario& s, const StationScenario& station,
                  const std::string& password_file) {
  out << "\n[camera]\n";
  if (station.rtsp) {
    out << "kind = \"rtsp\"\nurl = " << toml_text(stream_address(station))
        << "\ndelay_s = " << 0.5 * s.exposure_s + s.readout_s + kEncoder_s
        << "\ndelay_sd_s = " << kEncoder_s;
    if (station.mount == MountModel::kOnvif && !station.fixed)
      write_login(out, onvif_config(s, station), password_file);
  } else {
    out << "device = " << toml_text(station.camera_address)
        << "\nexposure_us = " << 1e6 * s.exposure_s << "\nreadout_s = " << s.readout_s;
  }
  out << "\nwidth_px = " << s.camera.width_px << "\nheight_px = " << s.camera.height_px
      << "\nframe_rate_hz = " << s.frame_rate_hz << "\n";
}

// The scales of the generic spaces, as its data sheet has them.
void write_onvif(std::ostream& out, const OnvifConfig& c, const std::string& password_file) {
  const PtzUnitConfig& unit = c.unit;
  out << "kind = \"onvif\"\nurl = "
      << toml_text("http://" + c.address + ":" + std::to_string(c.port) + "/onvif/device_service");
  write_login(out, c, password_file);
  out << "\npan_gain_deg = " << degrees(angle_rad(0, 1.0, unit) - angle_rad(0, 0.0, unit))
      << "\npan_zero_deg = " << degrees(angle_rad(0, 0.0, unit))
      << "\npan_speed_deg_s = " << degrees(full_speed_rad_s(0, unit))
      << "\ntilt_gain_deg = " << degrees(angle_rad(1, 1.0, unit) - angle_rad(1, 0.0, unit))
      << "\ntilt_zero_deg = " << degrees(angle_rad(1, 0.0, unit))
      << "\ntilt_speed_deg_s = " << degrees(full_speed_rad_s(1, unit)) << "\n";
  if (unit.repeatability_rad > 0.0)
    out << "position_sd_deg = " << degrees(unit.repeatability_rad) << "\n";
}

void write_devices(std::ostream& out, const Scenario& s, const StationScenario& station,
                   const std::string& line_folder) {
  const std::string password_file = line_folder + "/" + station.id + ".password";
  write_camera(out, s, station, password_file);
  out << "\n[mount]\n";
  if (station.fixed) {
    out << "kind = \"fixed\"\npan_deg = " << degrees(station.fixed->pan_rad)
        << "\ntilt_deg = " << degrees(station.fixed->tilt_rad) << "\n";
    return;
  }
  if (station.mount == MountModel::kExternal) return;  // only its own program knows its interface
  if (station.mount == MountModel::kIndi) {
    out << "kind = \"indi\"\nhost = " << toml_text(station.camera_address)
        << "\ndevice = \"OLS Telescope\"\naxes = \"equatorial\"\npan_min_deg = -120\n"
        << "pan_max_deg = 120\ntilt_min_deg = -85\ntilt_max_deg = 85\ndelay_s = 0\n"
        << "delay_sd_s = 0.01\npoll_interval_s = 0.05\nposition_sd_deg = 0.002\n";
    return;
  }
  if (station.mount == MountModel::kOnvif) {
    write_onvif(out, onvif_config(s, station), password_file);
    return;
  }
  out << "device = " << toml_text(line_folder + "/" + station.ptu_line) << "\nbaud = " << s.ptu.baud
      << "\npoll_interval_s = " << s.ptu.poll_interval_s << "\n";
}

// Each station on a loopback address of its own, that of its camera.
void write_video(std::ostream& out, const StationScenario& station) {
  constexpr int kPort = 7790;
  out << "\n[video]"
      << "\naddress = " << toml_text(station.camera_address + ":" + std::to_string(kPort)) << "\n";
}

void write_watch(std::ostream& out, const StationScenario& station) {
  if (!station.watch) return;
  out << "\n[watch]\nazimuth_deg = " << degrees(station.watch->azimuth_rad)
      << "\nelevation_deg = " << degrees(station.watch->elevation_rad) << "\nsize_deg = ["
      << degrees(station.watch_size_rad.x()) << ", " << degrees(station.watch_size_rad.y())
      << "]\n";
}

void write_sensors(std::ostream& out, const Scenario& s, std::size_t station,
                   const std::string& line_stem) {
  if (s.inclinometer.on) {
    constexpr double kLeastSd_rad = radians(0.002);
    out << "\n[inclinometer]"
        << "\ndevice = " << toml_text(line_stem + ".inclinometer") << "\nstuck_s = 10"
        << "\nsd_deg = " << degrees(std::max(s.inclinometer.zero_sd_rad, kLeastSd_rad)) << "\n";
  }
  if (s.gnss.on) {
    const Eigen::Vector3d& antenna = s.gnss.ground_to_antenna_enu_m;
    out << "\n[gnss]"
        << "\nhost = \"127.0.0.1\""
        << "\nport = " << s.gnss.gpsd_port + static_cast<int>(station)
        << "\nground_to_antenna_enu_m = [" << antenna.x() << ", " << antenna.y() << ", "
        << antenna.z() << "]\n";
  }
}

void write_gpio(std::ostream& out, const Scenario& s, const std::string& line_stem) {
  if (!s.gpio.on) return;
  const GpioServerConfig lines;
  out << "\n[gpio]"
      << "\nchip = " << toml_text("socket:" + line_stem + ".gpio")
      << "\nled_line = " << lines.led_line << "\nstop_line = " << lines.stop_line
      << "\nrearm_line = " << lines.rearm_line << "\n";
}

void leave_in_order(const std::string& state_folder, const std::string& id) {
  if (state_folder.empty()) return;
  std::filesystem::create_directories(state_folder);
  if (std::filesystem::exists(state_folder + "/" + id + ".hold")) return;
  station::PersistedStationState memory(state_folder, id, false);
  memory.remember(station::StationState::kIdle, std::nullopt, mount::Reference::kTrusted);
}

}  // namespace

std::string station_file(const World& world, std::size_t station,
                         const StationFileOptions& options) {
  const StationTruth& truth = world.stations()[station];
  std::ostringstream out;
  // All digits of a double, so that reading restores the written value.
  out << std::setprecision(17);
  out << "# Station " << truth.id << " of the simulated site " << toml_text(world.scenario().name)
      << ".\n"
      << "id = " << toml_text(truth.id) << "\nlcm_url = " << toml_text(options.lcm_url) << "\n"
      << (options.state_folder.empty() ? ""
                                       : "state_folder = " + toml_text(options.state_folder) + "\n")
      << (world.scenario().stations[station].overview ? "kind = \"overview\"\n" : "")
      << "tracker_seed = " << (derived_seed(world.seed(), 3000 + station) >> 1) << "\n";
  write_pose(out, truth.nominal);
  write_chain(out, truth.nominal.chain);
  write_lens(out, truth.nominal.camera);
  write_sd(out, world, truth.nominal.sd);
  out << "\n[clock]\nsd_s = " << truth.clock_sd_s << "\n";
  write_devices(out, world.scenario(), world.scenario().stations[station], options.line_folder);
  write_sensors(out, world.scenario(), station, options.line_folder + "/" + truth.id);
  write_gpio(out, world.scenario(), options.line_folder + "/" + truth.id);
  write_lens_motor(out, truth, options.line_folder + "/" + truth.id);
  write_video(out, world.scenario().stations[station]);
  out << "\n[detector]\nenabled = " << (world.scenario().detector_on ? "true" : "false") << "\n";
  write_watch(out, world.scenario().stations[station]);
  return out.str();
}

void write_station_files(const World& world, const StationFileOptions& options,
                         const std::string& folder) {
  std::filesystem::create_directories(folder);
  for (std::size_t i = 0; i < world.stations().size(); ++i) {
    AtomicFile file(folder + "/" + world.stations()[i].id + ".toml");
    file.stream() << station_file(world, i, options);
    file.commit();
    leave_in_order(options.state_folder, world.stations()[i].id);
  }
}

void write_calibration_rounds(const World& world, const StationFileOptions& options,
                              const std::string& folder) {
  write_station_files(world, options, folder);
  for (std::size_t i = 0; i < world.stations().size(); ++i) {
    const CalibrationRound round = calibration_round(world, i);
    const std::string stem = folder + "/" + world.stations()[i].id;
    for (const auto& [name, text] : {std::pair{".observations.jsonl", &round.observations},
                                     {".references.csv", &round.references}}) {
      AtomicFile file(stem + name);
      file.stream() << *text;
      file.commit();
    }
  }
}

std::vector<std::optional<StationCalibration>> read_calibrations(const World& world,
                                                                 const std::string& folder) {
  std::vector<std::optional<StationCalibration>> calibrations;
  for (const StationTruth& station : world.stations()) {
    calibrations.emplace_back();
    const std::string own = folder + "/" + station.id;
    if (!std::filesystem::exists(own)) continue;
    station::StationSettings settings;
    settings.id = station.id;
    settings.station.geometry = station.nominal;
    calibrations.back() = station::read_calibration(own, settings).calibration;
  }
  return calibrations;
}

}  // namespace ols::sim
