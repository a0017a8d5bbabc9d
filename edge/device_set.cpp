#include "edge/device_set.h"

namespace ols::station {

DeviceSet::DeviceSet(const StationSettings& settings)
    : stop_(!settings.gpio.chip.empty() && settings.gpio.stop_line >= 0),
      camera_(settings.camera),
      ptu_(settings.ptu) {
  if (!stop_.known()) ptu_.emergency_halt();
  if (!settings.recorder.folder.empty()) recorder_.emplace(settings.recorder);
  if (!settings.inclinometer.device.empty()) inclinometer_.emplace(settings.inclinometer);
  if (!settings.gnss.host.empty()) gnss_.emplace(settings.gnss);
  if (!settings.gpio.chip.empty()) {
    gpio_.emplace(
        settings.gpio, [this](bool pressed) { on_stop(pressed); }, [this] { stop_.rearm(); });
  }
}

// In the GPIO thread: halts the unit at once; the station follows in its next turn.
void DeviceSet::on_stop(bool pressed) {
  stop_.set(pressed);
  if (pressed) ptu_.emergency_halt();
}

// A press after the release is either seen here, or halts the unit after its release.
void DeviceSet::rearm() {
  ptu_.clear_emergency();
  if (stop_.pressed()) ptu_.emergency_halt();
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
  std::vector<device::DeviceReport> reports{camera_.report(), ptu_.report()};
  if (inclinometer_) reports.push_back(inclinometer_->report());
  if (gnss_) reports.push_back(gnss_->report());
  if (gpio_) reports.push_back(gpio_->report());
  if (recorder_) reports.push_back(recorder_->report());
  return reports;
}

}  // namespace ols::station
