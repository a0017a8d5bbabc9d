#include "edge/process/device_set.h"

#include <utility>

#include "edge/gpio/gpio.h"
#include "edge/lens/lens_motor.h"

namespace ols::station {

Head configured_head(const StationSettings& settings) {
  Head head;
  if (settings.inclinometer->is_configured()) head.inclinometer = settings.inclinometer->open();
  if (settings.gnss->is_configured()) head.gnss = settings.gnss->open();
  head.camera = settings.camera->open(settings.keep_raw);
  head.mount = settings.mount->open();
  if (!settings.lens.device.empty()) head.lens = std::make_unique<lens::LensMotor>(settings.lens);
  if (!settings.gpio.chip.empty()) {
    head.open_gpio = [config = settings.gpio](auto on_stop, auto on_rearm) {
      return std::make_unique<gpio::Gpio>(config, std::move(on_stop), std::move(on_rearm));
    };
  }
  return head;
}

DeviceSet::DeviceSet(const StationSettings& settings, std::int64_t boot_id, Head head)
    : stop_(settings.gpio.has_stop()), head_(std::move(head)) {
  if (!stop_.known()) head_.mount->emergency_halt();
  if (!settings.recorder.folder.empty()) recorder_.emplace(settings.recorder);
  if (!settings.video.address.empty()) {
    video_.emplace(settings.video, video::VideoSender{settings.id, boot_id});
  }
  if (head_.open_gpio) {
    gpio_ = head_.open_gpio([this](bool pressed) { on_stop(pressed); }, [this] { stop_.rearm(); });
  }
}

// In the GPIO thread: halts the mount at once; the station follows in its next turn.
void DeviceSet::on_stop(bool pressed) {
  stop_.set(pressed);
  if (pressed) head_.mount->emergency_halt();
}

// A press after clear_emergency() is seen by the next line, or on_stop() halts the mount.
void DeviceSet::rearm() {
  head_.mount->clear_emergency();
  if (stop_.pressed()) head_.mount->emergency_halt();
}

void DeviceSet::feed(sensors::PoseEstimator& estimator) {
  if (head_.inclinometer) {
    for (const sensors::TiltReading& reading : head_.inclinometer->take_readings())
      estimator.add(reading);
  }
  if (head_.gnss) {
    for (const sensors::GnssReading& reading : head_.gnss->take_readings()) estimator.add(reading);
  }
}

std::vector<device::DeviceReport> DeviceSet::reports() const {
  std::vector<device::DeviceReport> reports{head_.camera->report(), head_.mount->report()};
  if (head_.lens) reports.push_back(head_.lens->report());
  if (head_.inclinometer) reports.push_back(head_.inclinometer->report());
  if (head_.gnss) reports.push_back(head_.gnss->report());
  if (gpio_) reports.push_back(gpio_->report());
  if (recorder_) reports.push_back(recorder_->report());
  if (video_) reports.push_back(video_->report());
  return reports;
}

}  // namespace ols::station
