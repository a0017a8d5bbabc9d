// The simulated world in real time, with the interfaces of real devices. Every station has a GigE
// Vision or RTSP camera, and a PTU, inclinometer and GNSS receiver on ptys. The truth is published
// on channels that no product process reads. The scenario and the channel OLS_SIM_FAULT set the
// faults.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/bus/lcm_bus.h"
#include "sim/camera/simulated_camera.h"
#include "sim/ptu/device.h"
#include "sim/scenario/fault_plan.h"
#include "sim/world/renderer.h"
#include "sim/world/world.h"

namespace ols::sim {

class LiveSite {
 public:
  // At construction, the scenario's time is 0, and true UTC is the UTC of the host's clock.
  // Afterwards both advance with the monotonic clock: a step of the host's clock does not move the
  // targets. `line_folder`: folder of the links to the serial lines. Throws std::system_error if an
  // address or a link is not available.
  LiveSite(const World& world, const std::string& line_folder, LcmBus& bus);
  ~LiveSite();

  // Publishes the present state of each target (OLS_SIM_TRUTH), and the angles of each PTU since
  // the last call (OLS_SIM_PTU_<station>).
  void publish_truth();

  // Applies the active faults to every device. Call every few milliseconds, in the thread that
  // handles the bus.
  void apply_faults();

 private:
  struct Device;

  std::unique_ptr<PtuDevice> connect_ptu(std::size_t station, const std::string& link);
  std::unique_ptr<PtuDevice> connect_onvif(std::size_t station, const std::string& folder);
  std::unique_ptr<PtuDevice> connect_telescope(std::size_t station);
  std::unique_ptr<PtuDevice> connect_external(std::size_t station);
  void connect_camera(Device& device);
  void connect_sensors(Device& device, const std::string& link_stem);
  void receive_fault(const void* data, int bytes);
  void publish_target(std::size_t index, double now_s);
  void publish_ptu(Device& device, double now_s);
  void draw(Device& device, const Exposure& exposure, cv::Mat& gray);
  void publish_view(const Device& device, const ExposureTruth& exposure, const ViewTruth& view,
                    std::int64_t stamp_us);
  double scenario_s(std::int64_t monotonic_ns) const;
  std::int64_t true_utime_us(double scenario_s) const;

  const World& world_;
  LcmBus& bus_;
  std::mutex bus_mutex_;
  std::int64_t start_monotonic_ns_;
  std::int64_t start_utc_ns_;  // true UTC of that instant
  FaultPlan faults_;
  std::vector<std::unique_ptr<Device>> devices_;
};

}  // namespace ols::sim
