#include "sim/live/live_site.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "base/process/clocks.h"
#include "ols_msg/sim_fault_t.hpp"
#include "ols_msg/truth_ptu_t.hpp"
#include "ols_msg/truth_target_t.hpp"
#include "ols_msg/truth_view_t.hpp"
#include "sim/camera/fixed_camera.h"
#include "sim/camera/rtsp_server.h"
#include "sim/gpio/gpio_socket.h"
#include "sim/lens/lens_line.h"
#include "sim/onvif/server.h"
#include "sim/ptu/external_mount.h"
#include "sim/ptu/line.h"
#include "sim/ptu/tap.h"
#include "sim/scenario/onvif_camera.h"
#include "sim/sensors/gnss_line.h"
#include "sim/sensors/inclinometer_line.h"
#include "sim/telescope/telescope_server.h"
#include "sim/world/exposed_unit.h"

namespace ols::sim {
namespace {

constexpr double kPtuSample_s = 0.0025;
constexpr std::int64_t kMostPtuSamples = 400;  // a line keeps two seconds

}  // namespace

// One station's devices. The camera's thread draws, so it ends before the objects that it uses.
struct LiveSite::Device {
  std::size_t station = 0;
  std::unique_ptr<Renderer> renderer;
  std::unique_ptr<PtuDevice> ptu;
  std::unique_ptr<ExposedUnit> exposed;
  std::unique_ptr<LensLine> lens;           // null: a fixed one
  std::unique_ptr<SimulatedCamera> camera;  // or
  std::unique_ptr<RtspServer> rtsp;
  std::unique_ptr<GpioServer> gpio;
  std::unique_ptr<InclinometerLine> inclinometer;  // null: not in the scenario
  std::unique_ptr<GnssLine> gnss;
  StationFaults faults;              // as applied
  std::atomic<ByHand> by_hand;       // the same, for the camera's thread
  std::int64_t stop_edge_utime = 0;  // true UTC
  std::int64_t ptu_samples = 0;      // published, since the scenario's start
};

LiveSite::LiveSite(const World& world, const std::string& line_folder, LcmBus& bus)
    : world_(world), bus_(bus) {
  auto renderers = make_renderers(world);
  std::filesystem::create_directories(line_folder);
  start_monotonic_ns_ = clock_monotonic_ns();
  start_utc_ns_ = clock_utc_ns();
  const Scenario& s = world.scenario();
  for (std::size_t i = 0; i < s.stations.size(); ++i) {
    auto device = std::make_unique<Device>();
    device->station = i;
    device->renderer = std::move(renderers[i]);
    device->ptu = connect_ptu(i, line_folder + "/" + s.stations[i].ptu_line);
    device->exposed =
        std::make_unique<ExposedUnit>(world.stations()[i].unit, world.ptu_unit_config());
    GpioServerConfig gpio;
    gpio.path = line_folder + "/" + s.stations[i].id + ".gpio";
    device->gpio = std::make_unique<GpioServer>(gpio);
    connect_sensors(*device, line_folder + "/" + s.stations[i].id);
    if (!s.stations[i].zoom.is_fixed()) {
      device->lens =
          std::make_unique<LensLine>(LensUnitConfig{.zoom_travel_s = s.stations[i].zoom.travel_s},
                                     line_folder + "/" + s.stations[i].id + ".lens");
    }
    connect_camera(*device);
    devices_.push_back(std::move(device));
  }
  for (const Fault& fault : s.faults) faults_.add(fault);
  bus.subscribe("OLS_SIM_FAULT", [this](const BusMessage& message) {
    receive_fault(message.payload.data(), static_cast<int>(message.payload.size()));
  });
}

LiveSite::~LiveSite() = default;

// The simulated unit, a real one in its place, or none.
std::unique_ptr<PtuDevice> LiveSite::connect_ptu(std::size_t station, const std::string& link) {
  const StationScenario& scenario = world_.scenario().stations[station];
  if (scenario.fixed) return std::make_unique<FixedCamera>(*scenario.fixed);
  if (scenario.mount == MountModel::kOnvif)
    return connect_onvif(station, std::filesystem::path(link).parent_path());
  if (scenario.mount == MountModel::kIndi) return connect_telescope(station);
  if (scenario.mount == MountModel::kExternal) return connect_external(station);
  const std::string& real_device = scenario.ptu_device;
  const std::uint64_t seed = derived_seed(world_.seed(), 4000 + station);
  if (real_device.empty()) return std::make_unique<PtuLine>(world_.ptu_unit_config(), seed, link);
  PtuTapConfig tap;
  tap.device = real_device;
  tap.baud = world_.scenario().ptu.baud;
  return std::make_unique<PtuTap>(tap, seed, link);
}

// Its password lies in the folder of the lines.
std::unique_ptr<PtuDevice> LiveSite::connect_onvif(std::size_t station, const std::string& folder) {
  const StationScenario& scenario = world_.scenario().stations[station];
  const OnvifConfig config = onvif_config(world_.scenario(), scenario);
  const std::string file = folder + "/" + scenario.id + ".password";
  std::ofstream(file) << config.password << "\n";
  std::filesystem::permissions(file, std::filesystem::perms(0600));
  return std::make_unique<OnvifServer>(config, derived_seed(world_.seed(), 7000 + station));
}

std::unique_ptr<PtuDevice> LiveSite::connect_telescope(std::size_t station) {
  const Scenario& scenario = world_.scenario();
  TelescopeConfig config;
  config.address = scenario.stations[station].camera_address;
  config.observer = {scenario.origin.latitude_rad, scenario.origin.longitude_rad};
  return std::make_unique<TelescopeServer>(config, derived_seed(world_.seed(), 7500 + station));
}

std::unique_ptr<PtuDevice> LiveSite::connect_external(std::size_t station) {
  auto mount = std::make_unique<ExternalMount>();
  // The bus is handled only while this site and so the mount exist.
  bus_.subscribe(
      "OLS_SIM_ANGLES_" + world_.scenario().stations[station].id,
      [this, mount = mount.get()](const BusMessage& message) {
        ols_msg::truth_ptu_t angles;
        if (!decode_exactly(message, angles)) return;
        const double first_s =
            1e-9 * static_cast<double>(start_monotonic_ns_ + 1000 * angles.utime - start_utc_ns_);
        for (std::size_t i = 0; i < angles.pan_rad.size(); ++i)
          mount->state(first_s + static_cast<double>(i) * angles.interval_s,
                       {angles.pan_rad[i], angles.tilt_rad[i]});
      });
  return mount;
}

void LiveSite::connect_camera(Device& device) {
  const Scenario& s = world_.scenario();
  const StationScenario& station = s.stations[device.station];
  const auto paint = [this, &device](const Exposure& exposure, cv::Mat& gray) {
    draw(device, exposure, gray);
  };
  if (station.rtsp) {
    // A PTZ camera has one login for both.
    const OnvifConfig ptz = onvif_config(s, station);
    const bool is_ptz = station.mount == MountModel::kOnvif && !station.fixed;
    device.rtsp =
        std::make_unique<RtspServer>(RtspServerConfig{.address = station.camera_address,
                                                      .user = is_ptz ? ptz.user : "",
                                                      .password = is_ptz ? ptz.password : "",
                                                      .width_px = s.camera.width_px,
                                                      .height_px = s.camera.height_px,
                                                      .frame_rate_hz = s.frame_rate_hz,
                                                      .exposure_s = s.exposure_s,
                                                      .delay_s = s.readout_s},
                                     paint);
    return;
  }
  SimulatedCameraConfig camera;
  camera.address = station.camera_address;
  camera.serial = station.id;
  camera.width_px = s.camera.width_px;
  camera.height_px = s.camera.height_px;
  camera.exposure_s = s.exposure_s;
  camera.readout_s = s.readout_s;
  device.camera = std::make_unique<SimulatedCamera>(camera, paint);
}

void LiveSite::connect_sensors(Device& device, const std::string& link_stem) {
  const Scenario& s = world_.scenario();
  const StationGeometry& truth = world_.stations()[device.station].truth;
  if (s.inclinometer.on) {
    InclinometerLineConfig c;
    c.tilt_x_rad = truth.chain.tilt_x_rad;
    c.tilt_y_rad = truth.chain.tilt_y_rad;
    c.zero_sd_rad = s.inclinometer.zero_sd_rad;
    c.noise_sd_rad = s.inclinometer.noise_sd_rad;
    device.inclinometer = std::make_unique<InclinometerLine>(
        c, derived_seed(world_.seed(), 5000 + device.station), link_stem + ".inclinometer");
  }
  if (s.gnss.on) {
    GnssLineConfig c;
    c.antenna =
        geodetic_from_ecef(LocalFrame(truth.position).to_ecef(s.gnss.ground_to_antenna_enu_m));
    c.sd_horizontal_m = s.gnss.sd_m;
    c.sd_up_m = 1.5 * s.gnss.sd_m;
    const auto utime_us = [this] { return true_utime_us(scenario_s(clock_monotonic_ns())); };
    device.gnss = std::make_unique<GnssLine>(
        c, utime_us, derived_seed(world_.seed(), 6000 + device.station), link_stem + ".gnss");
  }
}

double LiveSite::scenario_s(std::int64_t monotonic_ns) const {
  return 1e-9 * static_cast<double>(monotonic_ns - start_monotonic_ns_);
}

std::int64_t LiveSite::true_utime_us(double scenario_s) const {
  return start_utc_ns_ / 1000 + std::llround(scenario_s * 1e6);
}

void LiveSite::draw(Device& device, const Exposure& exposure, cv::Mat& gray) {
  // The host's clock is the station's clock; the world is drawn at the true time of that instant.
  const double offset_s = world_.stations()[device.station].clock_offset_s;
  const std::int64_t mid_monotonic_ns =
      exposure.start_monotonic_ns + std::llround(0.5e9 * exposure.exposure_s);
  const double mid_monotonic_s = 1e-9 * static_cast<double>(mid_monotonic_ns);
  const double half_s = 0.5 * exposure.exposure_s;
  ExposureTruth truth;
  truth.mid_s = scenario_s(mid_monotonic_ns) - offset_s;
  truth.exposure_s = exposure.exposure_s;
  device.ptu->await(mid_monotonic_s + half_s + device.exposed->longest_wait_s());
  device.exposed->expose([&device](double at_s) { return device.ptu->angles_at(at_s); },
                         mid_monotonic_s, truth);
  if (device.lens) truth.zoom = device.lens->zoom_at(mid_monotonic_s);
  truth.frame = exposure.frame;
  truth.light =
      exposure.exposure_s / world_.scenario().exposure_s * std::pow(10.0, exposure.gain_dB / 20.0);
  truth.by_hand = device.by_hand;
  if (world_.scenario().landscape.sun) {
    truth.sun =
        sun_over(world_.stations()[device.station].truth.position, true_utime_us(truth.mid_s));
  }
  const ViewTruth view = device.renderer->draw(truth, gray);
  const std::int64_t mid_utc_ns = clock_utc_ns() - (clock_monotonic_ns() - mid_monotonic_ns);
  publish_view(device, truth, view, mid_utc_ns / 1000);
}

void LiveSite::publish_view(const Device& device, const ExposureTruth& exposure,
                            const ViewTruth& view, std::int64_t stamp_us) {
  ols_msg::truth_view_t message;
  message.utime = true_utime_us(exposure.mid_s);
  message.stamp_utime = stamp_us;
  message.station = world_.stations()[device.station].id;
  message.frame = static_cast<std::int64_t>(exposure.frame);
  message.visible = static_cast<std::int8_t>(view.visible);
  message.centre_px[0] = view.centre_px.x();
  message.centre_px[1] = view.centre_px.y();
  message.box_px[0] = view.box.x;
  message.box_px[1] = view.box.y;
  message.box_px[2] = view.box.width;
  message.box_px[3] = view.box.height;
  message.pan_rad = exposure.mid.pan_rad;
  message.tilt_rad = exposure.mid.tilt_rad;
  const std::lock_guard lock(bus_mutex_);
  bus_.publish("OLS_SIM_VIEW_" + message.station, message);
}

void LiveSite::publish_target(std::size_t index, double now_s) {
  const TargetTruth target = world_.target(index, now_s);
  ols_msg::truth_target_t message;
  message.utime = true_utime_us(now_s);
  message.target_id = static_cast<std::int64_t>(index);
  for (int axis = 0; axis < 3; ++axis) {
    message.position_ecef_m[axis] = target.p_ecef[axis];
    message.velocity_ecef_m_s[axis] = target.v_ecef[axis];
  }
  const std::lock_guard lock(bus_mutex_);
  bus_.publish("OLS_SIM_TRUTH", message);
}

void LiveSite::publish_ptu(Device& device, double now_s) {
  const auto due = static_cast<std::int64_t>(now_s / kPtuSample_s);
  // After a pause of this process, only the time that the line still keeps.
  device.ptu_samples = std::max(device.ptu_samples, due - kMostPtuSamples);
  ols_msg::truth_ptu_t message;
  message.utime = true_utime_us(static_cast<double>(device.ptu_samples) * kPtuSample_s);
  message.station = world_.stations()[device.station].id;
  message.interval_s = kPtuSample_s;
  for (; device.ptu_samples < due; ++device.ptu_samples) {
    const double at_s = static_cast<double>(device.ptu_samples) * kPtuSample_s;
    const PanTilt angles =
        device.ptu->angles_at(at_s + 1e-9 * static_cast<double>(start_monotonic_ns_));
    message.pan_rad.push_back(angles.pan_rad);
    message.tilt_rad.push_back(angles.tilt_rad);
  }
  message.samples = static_cast<std::int16_t>(message.pan_rad.size());
  message.stop_pressed = static_cast<std::int8_t>(device.faults.stop_pressed);
  message.stop_edge_utime = device.stop_edge_utime;
  const std::lock_guard lock(bus_mutex_);
  bus_.publish("OLS_SIM_PTU_" + message.station, message);
}

void LiveSite::publish_truth() {
  const double now_s = scenario_s(clock_monotonic_ns());
  for (std::size_t i = 0; i < world_.scenario().targets.size(); ++i) publish_target(i, now_s);
  for (const auto& device : devices_) publish_ptu(*device, now_s);
}

void LiveSite::receive_fault(const void* data, int bytes) {
  ols_msg::sim_fault_t message;
  if (!decode_exactly(data, bytes, message)) return;
  const double now_s = scenario_s(clock_monotonic_ns());
  try {
    faults_.command({message.kind, message.station, now_s, message.duration_s, message.value},
                    now_s);
    std::cout << now_s << " s: " << message.kind << " at "
              << (message.station.empty() ? "all stations" : message.station) << " for "
              << message.duration_s << " s, value " << message.value << std::endl;
  } catch (const std::invalid_argument& problem) {
    std::cerr << "ols-sim: OLS_SIM_FAULT refused: " << problem.what() << std::endl;
  }
}

void LiveSite::apply_faults() {
  const double now_s = scenario_s(clock_monotonic_ns());
  for (const auto& device : devices_) {
    const StationFaults now = faults_.at(world_.stations()[device->station].id, now_s);
    if (now == device->faults) continue;
    device->ptu->set_faults(now.ptu);
    if (device->camera) device->camera->set_faults(now.camera);
    if (device->rtsp) device->rtsp->set_faults(now.camera);
    if (device->inclinometer) device->inclinometer->set_faults(now.inclinometer);
    if (device->gnss) device->gnss->set_faults(now.gnss);
    if (now.stop_pressed != device->faults.stop_pressed) {
      device->gpio->set_pressed(now.stop_pressed);
      device->stop_edge_utime = true_utime_us(scenario_s(clock_monotonic_ns()));
    }
    if (device->gpio) device->gpio->hold_rearm(now.rearm_held);
    device->by_hand = now.by_hand;
    device->faults = now;
  }
}

}  // namespace ols::sim
