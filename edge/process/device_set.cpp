#include "edge/process/device_set.h"

#include <utility>

namespace ols::station {

Head configured_head(const StationSettings& settings) {
  return {settings.camera->open(settings.keep_raw), settings.mount->open()};
}

DeviceSet::DeviceSet(const StationSettings& settings, std::int64_t boot_id, Head head)
    : stop_(settings.gpio.has_stop()), head_(std::move(head)) {
  if (!stop_.known()) head_.mount->emergency_halt();
  if (!settings.recorder.folder.empty()) recorder_.emplace(settings.recorder);
  if (!settings.video.address.empty()) {
    video_.emplace(settings.video, video::VideoSender{settings.id, boot_id});
  }
  if (!settings.lens.device.empty()) lens_.emplace(settings.lens);
  if (settings.inclinometer->is_configured()) inclinometer_ = settings.inclinometer->open();
  if (settings.gnss->is_configured()) gnss_ = settings.gnss->open();
  if (!settings.gpio.chip.empty()) {
    gpio_.emplace(
        settings.gpio, [this](bool pressed) { on_stop(pressed); }, [this] { stop_.rearm(); });
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
  if (inclinometer_) {
    for (const sensors::TiltReading& reading : inclinometer_->take_readings())
      estimator.add(reading);
  }
  if (gnss_) {
    for (const sensors::GnssReading& reading : gnss_->take_readings()) estimator.add(reading);
  }
}

std::vector<device::DeviceReport> DeviceSet::reports() const {
  std::vector<device::DeviceReport> reports{head_.camera->report(), head_.mount->report()};
  if (lens_) reports.push_back(lens_->report());
  if (inclinometer_) reports.push_back(inclinometer_->report());
  if (gnss_) reports.push_back(gnss_->report());
  if (gpio_) reports.push_back(gpio_->report());
  if (recorder_) reports.push_back(recorder_->report());
  if (video_) reports.push_back(video_->report());
  return reports;
}

}  // namespace ols::station
