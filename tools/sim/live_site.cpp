#include "tools/sim/live_site.h"

#include <cmath>
#include <filesystem>

#include "base/clocks.h"
#include "ols_msg/truth_target_t.hpp"
#include "ols_msg/truth_view_t.hpp"

namespace ols::sim {

// One station's devices. The camera's thread draws, so it ends before what it draws with.
struct LiveSite::Device {
  std::size_t station = 0;
  std::unique_ptr<Renderer> renderer;
  std::unique_ptr<PtuLine> ptu;
  std::unique_ptr<CameraServer> camera;
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
    device->ptu =
        std::make_unique<PtuLine>(world.ptu_unit_config(), derived_seed(world.seed(), 4000 + i),
                                  line_folder + "/" + s.stations[i].ptu_line);
    CameraServerConfig camera;
    camera.address = s.stations[i].camera_address;
    camera.serial = s.stations[i].id;
    camera.width_px = s.camera.width_px;
    camera.height_px = s.camera.height_px;
    camera.exposure_s = s.exposure_s;
    camera.readout_s = s.readout_s;
    device->camera = std::make_unique<CameraServer>(
        camera, [this, &device = *device](const Exposure& exposure, cv::Mat& gray) {
          draw(device, exposure, gray);
        });
    devices_.push_back(std::move(device));
  }
}

LiveSite::~LiveSite() = default;

double LiveSite::scenario_s(std::int64_t monotonic_ns) const {
  return 1e-9 * static_cast<double>(monotonic_ns - start_monotonic_ns_);
}

std::int64_t LiveSite::true_utime_us(double scenario_s) const {
  return start_utc_ns_ / 1000 + std::llround(scenario_s * 1e6);
}

void LiveSite::draw(Device& device, const Exposure& exposure, cv::Mat& gray) {
  // The host's clock is the station's clock; the world is seen at the true time of that instant.
  // The exposure's stamp is a moment old: a step of the host's clock before that is in both.
  const double offset_s = world_.stations()[device.station].clock_offset_s;
  const std::int64_t mid_ns =
      exposure.start_realtime_ns + std::llround(0.5e9 * exposure.exposure_s);
  const std::int64_t mid_monotonic_ns = clock_monotonic_ns() - (clock_utc_ns() - mid_ns);
  const double mid_monotonic_s = 1e-9 * static_cast<double>(mid_monotonic_ns);
  const double half_s = 0.5 * exposure.exposure_s;
  ExposureTruth truth;
  truth.mid_s = scenario_s(mid_monotonic_ns) - offset_s;
  truth.exposure_s = exposure.exposure_s;
  truth.start = device.ptu->angles_at(mid_monotonic_s - half_s);
  truth.mid = device.ptu->angles_at(mid_monotonic_s);
  truth.end = device.ptu->angles_at(mid_monotonic_s + half_s);
  truth.frame = exposure.frame;
  const ViewTruth view = device.renderer->draw(truth, gray);
  publish_view(device, truth, view, mid_ns / 1000);
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

void LiveSite::publish_truth() {
  const double now_s = scenario_s(clock_monotonic_ns());
  for (std::size_t i = 0; i < world_.scenario().targets.size(); ++i) {
    const TargetTruth target = world_.target(i, now_s);
    ols_msg::truth_target_t message;
    message.utime = true_utime_us(now_s);
    message.target_id = static_cast<std::int64_t>(i);
    for (int axis = 0; axis < 3; ++axis) {
      message.position_ecef_m[axis] = target.p_ecef[axis];
      message.velocity_ecef_m_s[axis] = target.v_ecef[axis];
    }
    const std::lock_guard lock(bus_mutex_);
    bus_.publish("OLS_SIM_TRUTH", message);
  }
}

}  // namespace ols::sim
