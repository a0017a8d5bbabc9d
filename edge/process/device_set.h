// The devices of a station. Each has its own thread, and any of them may be absent.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "edge/camera/camera.h"
#include "edge/command/stop_latch.h"
#include "edge/config/config.h"
#include "edge/device/device_report.h"
#include "edge/gpio/gpio_handover.h"
#include "edge/lens/lens_handover.h"
#include "edge/mount/mount.h"
#include "edge/recorder/recorder.h"
#include "edge/sensors/gnss.h"
#include "edge/sensors/inclinometer.h"
#include "edge/sensors/pose_estimator.h"
#include "edge/video/video_server.h"

namespace ols::station {

using OpenGpio = std::function<std::unique_ptr<gpio::GpioHandover>(gpio::GpioHandover::OnStop,
                                                                   gpio::GpioHandover::OnRearm)>;

// The devices that a configuration names. A simulation provides simulated ones instead.
struct ChosenDevices {
  // The members are null for devices that are not configured. `open_gpio` makes the GPIO, whose
  // thread calls the two callbacks.
  OpenGpio open_gpio;
  std::unique_ptr<lens::LensHandover> lens;
  std::unique_ptr<sensors::Inclinometer> inclinometer;
  std::unique_ptr<sensors::Gnss> gnss;
  std::unique_ptr<camera::Camera> camera;
  // Last member, so that the mount is destroyed first: its destructor halts the motion, and the
  // other destructors may take long.
  std::unique_ptr<mount::Mount> mount;
};
using OpenDevices = std::function<ChosenDevices(const StationSettings&)>;
ChosenDevices open_chosen_devices(const StationSettings& settings);

class DeviceSet {
 public:
  DeviceSet(const StationSettings& settings, std::int64_t boot_id, ChosenDevices chosen);
  DeviceSet(const DeviceSet&) = delete;
  DeviceSet& operator=(const DeviceSet&) = delete;

  camera::Camera& camera() { return *chosen_.camera; }
  mount::Mount& mount() { return *chosen_.mount; }
  // The following functions return null or nullopt if the device is not configured.
  gpio::GpioHandover* gpio() { return gpio_.get(); }
  lens::LensHandover* lens() { return chosen_.lens.get(); }
  std::optional<recorder::Recorder>& recorder() { return recorder_; }
  std::optional<video::VideoServer>& video() { return video_; }
  StopLatch& stop() { return stop_; }
  const StopLatch& stop() const { return stop_; }

  // Gives `estimator` the readings that the sensors have made since the last call.
  void feed(sensors::PoseEstimator& estimator);
  // Permits the mount to move after an emergency stop, unless the stop has been pressed again. Also
  // needed once after the start, if a stop is configured: the constructor halts the mount, because
  // the stop's level is not known yet.
  void rearm();

  // Reports of all configured devices; camera and mount come first.
  std::vector<device::DeviceReport> reports() const;

 private:
  void on_stop(bool pressed);

  StopLatch stop_;
  std::optional<recorder::Recorder> recorder_;
  std::optional<video::VideoServer> video_;
  // gpio_ is the last member and thus destroyed first, because its thread uses the mount.
  ChosenDevices chosen_;
  std::unique_ptr<gpio::GpioHandover> gpio_;
};

}  // namespace ols::station
