#include "edge/process/device_set.h"

#include <utility>

#include "edge/gpio/gpio.h"
#include "edge/lens/lens_motor.h"

namespace ols::station {

ChosenDevices open_chosen_devices(const StationSettings& settings) {
  ChosenDevices chosen;
  if (settings.inclinometer->is_configured()) chosen.inclinometer = settings.inclinometer->open();
  if (settings.gnss->is_configured()) chosen.gnss = settings.gnss->open();
  chosen.camera = settings.camera->open(settings.keep_raw);
  chosen.mount = settings.mount->open();
  if (!settings.lens.device.empty()) chosen.lens = std::make_unique<lens::LensMotor>(settings.lens);
  if (!settings.gpio.chip.empty()) {
    chosen.open_gpio = [config = settings.gpio](auto on_stop, auto on_rearm) {
      return std::make_unique<gpio::Gpio>(config, std::move(on_stop), std::move(on_rearm));
    };
  }
  return chosen;
}

DeviceSet::DeviceSet(const StationSettings& settings, std::int64_t boot_id, ChosenDevices chosen)
    : stop_(settings.gpio.has_stop()), chosen_(std::move(chosen)) {
  if (!stop_.known()) chosen_.mount->emergency_halt();
  if (!settings.recorder.folder.empty()) recorder_.emplace(settings.recorder);
  if (!settings.video.address.empty()) {
    video_.emplace(settings.video, video::VideoSender{settings.id, boot_id});
  }
  if (chosen_.open_gpio) {
    gpio_ =
        chosen_.open_gpio([this](bool pressed) { on_stop(pressed); }, [this] { stop_.rearm(); });
  }
}

// In the GPIO thread: halts the mount at once; the station follows in its next turn.
void DeviceSet::on_stop(bool pressed) {
  stop_.set(pressed);
  if (pressed) chosen_.mount->emergency_halt();
}

// A press after clear_emergency() is seen by the next line, or on_stop() halts the mount.
void DeviceSet::rearm() {
  chosen_.mount->clear_emergency();
  if (stop_.pressed()) chosen_.mount->emergency_halt();
}

void DeviceSet::feed(sensors::PoseEstimator& estimator) {
  if (chosen_.inclinometer) {
    for (const sensors::TiltReading& reading : chosen_.inclinometer->take_readings())
      estimator.add(reading);
  }
  if (chosen_.gnss) {
    for (const sensors::GnssReading& reading : chosen_.gnss->take_readings())
      estimator.add(reading);
  }
}

std::vector<device::DeviceReport> DeviceSet::reports() const {
  std::vector<device::DeviceReport> reports{chosen_.camera->report(), chosen_.mount->report()};
  if (chosen_.lens) reports.push_back(chosen_.lens->report());
  if (chosen_.inclinometer) reports.push_back(chosen_.inclinometer->report());
  if (chosen_.gnss) reports.push_back(chosen_.gnss->report());
  if (gpio_) reports.push_back(gpio_->report());
  if (recorder_) reports.push_back(recorder_->report());
  if (video_) reports.push_back(video_->report());
  return reports;
}

}  // namespace ols::station
