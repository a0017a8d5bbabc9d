#include "edge/device_set.h"

namespace ols {
namespace {

DeviceReport report_of(const AravisCamera& camera) {
  DeviceReport report;
  report.name = "camera";
  switch (camera.state()) {
    case CameraState::kAbsent:
      report.state = DeviceState::kAbsent;
      break;
    case CameraState::kStarting:
      report.state = DeviceState::kStarting;
      break;
    case CameraState::kStreaming:
      report.state = DeviceState::kOk;
      break;
    case CameraState::kFault:
      report.state = DeviceState::kFault;
      break;
  }
  report.last_error = camera.last_error();
  const CameraCounters counters = camera.counters();
  report.counters = {{"frames_captured", counters.frames_captured},
                     {"frames_lost", counters.frames_lost},
                     {"frames_incomplete", counters.frames_incomplete},
                     {"frames_late", counters.frames_late},
                     {"frames_refused", counters.frames_refused},
                     {"camera_reconnects", counters.reconnects}};
  return report;
}

DeviceReport report_of(const PtuThread& thread) {
  const PtuStatus ptu = thread.status();
  DeviceReport report;
  report.name = "ptu";
  if (ptu.port_open) {
    report.state = ptu.state == PtuState::kReady      ? DeviceState::kOk
                   : ptu.state == PtuState::kStarting ? DeviceState::kStarting
                                                      : DeviceState::kFault;
  }
  report.text = ptu.firmware;
  report.last_error = ptu.last_error;
  report.errors = ptu.port_failures + ptu.counters.errors + ptu.counters.timeouts;
  report.counters = {
      {"ptu_requests", ptu.counters.requests},     {"ptu_replies", ptu.counters.replies},
      {"ptu_timeouts", ptu.counters.timeouts},     {"ptu_errors", ptu.counters.errors},
      {"ptu_garbled", ptu.counters.garbled},       {"ptu_restarts", ptu.counters.restarts},
      {"ptu_limit_hits", ptu.counters.limit_hits}, {"ptu_port_failures", ptu.port_failures}};
  return report;
}

}  // namespace

DeviceSet::DeviceSet(const StationSettings& settings)
    : camera_(settings.camera), ptu_(settings.ptu) {
  if (!settings.recorder.folder.empty()) recorder_.emplace(settings.recorder);
  if (!settings.inclinometer.device.empty()) inclinometer_.emplace(settings.inclinometer);
  if (!settings.gnss.host.empty()) gnss_.emplace(settings.gnss);
  if (!settings.gpio.chip.empty()) {
    gpio_.emplace(settings.gpio, [this](bool pressed) { on_stop(pressed); });
  }
}

// In the GPIO's thread: the unit is halted at once, the station learns of it in its next turn.
void DeviceSet::on_stop(bool pressed) {
  stop_.set(pressed);
  if (pressed) ptu_.set_goal(std::nullopt);
}

// A press after the release is either seen here or halts the unit after it was released.
void DeviceSet::rearm() {
  if (stop_.pressed()) ptu_.set_goal(std::nullopt);
}

void DeviceSet::feed(PoseKeeper& keeper) {
  if (inclinometer_) {
    for (const TiltReading& reading : inclinometer_->take_readings()) keeper.add(reading);
  }
  if (gnss_) {
    for (const GnssReading& reading : gnss_->take_readings()) keeper.add(reading);
  }
}

std::vector<DeviceReport> DeviceSet::reports() const {
  std::vector<DeviceReport> reports{report_of(camera_), report_of(ptu_)};
  if (inclinometer_) reports.push_back(inclinometer_->report());
  if (gnss_) reports.push_back(gnss_->report());
  if (gpio_) reports.push_back(gpio_->report());
  if (recorder_) reports.push_back(recorder_->report());
  return reports;
}

}  // namespace ols
