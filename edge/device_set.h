// The devices of a station, each with a thread of its own and each perhaps absent.
#pragma once

#include <optional>
#include <vector>

#include "edge/camera/aravis_camera.h"
#include "edge/config.h"
#include "edge/device_report.h"
#include "edge/gpio/gpio.h"
#include "edge/ptu/ptu_thread.h"
#include "edge/recorder/recorder.h"
#include "edge/sensors/gnss.h"
#include "edge/sensors/inclinometer.h"
#include "edge/sensors/pose_estimator.h"
#include "edge/stop_latch.h"

namespace ols::station {

class DeviceSet {
 public:
  explicit DeviceSet(const StationSettings& settings);
  DeviceSet(const DeviceSet&) = delete;
  DeviceSet& operator=(const DeviceSet&) = delete;

  camera::AravisCamera& camera() { return camera_; }
  ptu::PtuThread& ptu() { return ptu_; }
  // Nothing where none is configured.
  std::optional<gpio::Gpio>& gpio() { return gpio_; }
  std::optional<recorder::Recorder>& recorder() { return recorder_; }
  StopLatch& stop() { return stop_; }
  const StopLatch& stop() const { return stop_; }

  // What the sensors have read since the last call.
  void feed(sensors::PoseEstimator& keeper);
  // Lets the PTU move after an emergency, unless the stop has been pressed meanwhile; or at first:
  // where there is a stop it stands until the stop's level is known.
  void rearm();

  // Of every configured device, camera and PTU first.
  std::vector<DeviceReport> reports() const;

 private:
  void on_stop(bool pressed);

  StopLatch stop_;
  std::optional<recorder::Recorder> recorder_;
  std::optional<sensors::Inclinometer> inclinometer_;
  std::optional<sensors::Gnss> gnss_;
  camera::AravisCamera camera_;
  // Before the camera ends, whatever it is waiting for: the PTU's end halts the unit. The GPIO's
  // thread speaks to the PTU and ends before it.
  ptu::PtuThread ptu_;
  std::optional<gpio::Gpio> gpio_;
};

}  // namespace ols::station
