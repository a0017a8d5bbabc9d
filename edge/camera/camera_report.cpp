#include "edge/camera/camera_report.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "conditions/alarms.h"
#include "conditions/printed.h"

namespace ols::camera {
namespace {

constexpr double kSilence_s = 0.5;  // or three frame periods: a fault
// A busy computer leaves out some frames: an alarm is what lasts longer, or makes the camera be
// opened again.
constexpr double kAlarmingSilence_s = 1.5;
constexpr double kMuchLight = 1.3;  // factor

device::DeviceState device_state(CameraState state) {
  switch (state) {
    case CameraState::kAbsent:
      return device::DeviceState::kAbsent;
    case CameraState::kStarting:
      return device::DeviceState::kStarting;
    case CameraState::kStreaming:
      return device::DeviceState::kOk;
    case CameraState::kFault:
      return device::DeviceState::kFault;
  }
  return device::DeviceState::kFault;
}

Alarm alarm_of(PtpState state) {
  switch (state) {
    case PtpState::kSyncing:
      return alarm::ptp_not_yet();
    case PtpState::kMaster:
      return alarm::ptp_master();
    case PtpState::kFault:
      return alarm::ptp_faulty();
    default:
      return alarm::ptp_off();
  }
}

// The time without frames, if it is longer than this and three frame periods.
std::optional<double> silence_s(const CameraConfig& config, const CameraFacts& facts, double now_s,
                                double longest_s = kSilence_s) {
  const auto since = facts.last_frame_s ? facts.last_frame_s : facts.opened_s;
  if (!since) return std::nullopt;
  const double silent_s = now_s - *since;
  if (silent_s <= std::max(longest_s, 3.0 / config.frame_rate_hz)) return std::nullopt;
  return silent_s;
}

void add_alarms(const CameraConfig& config, const CameraFacts& facts, double now_s,
                std::vector<Alarm>& alarms) {
  const bool is_open = facts.state == CameraState::kStreaming;
  const auto silent_s = silence_s(config, facts, now_s, is_open ? kAlarmingSilence_s : kSilence_s);
  if (!facts.fault.empty()) alarms.push_back(facts.fault);
  if (silent_s) {
    const bool waits = !is_timed(config.trigger) && facts.state != CameraState::kAbsent;
    alarms.push_back(waits ? alarm::camera_no_trigger(*silent_s)
                           : alarm::camera_no_frames(*silent_s));
  } else if (facts.state == CameraState::kAbsent) {
    alarms.push_back(alarm::camera_silent());
  }
  if (facts.last_frame_s && facts.stamp_source == StampSource::kArrival)
    alarms.push_back(alarm::camera_stamps_of_host(1e3 * facts.stamp_sd_s));
  if (facts.incomplete_share > kManyIncomplete)
    alarms.push_back(alarm::camera_frames_incomplete(100.0 * facts.incomplete_share));
  if (facts.missing_light > kMuchLight) alarms.push_back(alarm::image_too_dark());
  if (facts.missing_light < 1.0 / kMuchLight) alarms.push_back(alarm::image_too_bright());
  if (facts.ptp && *facts.ptp != PtpState::kSlave) alarms.push_back(alarm_of(*facts.ptp));
  if (facts.ptp_disagreement_s) alarms.push_back(alarm::ptp_differs(*facts.ptp_disagreement_s));
  if (facts.state == CameraState::kStreaming)
    alarms.insert(alarms.end(), facts.kind_alarms.begin(), facts.kind_alarms.end());
}

}  // namespace

std::optional<Alarm> rate_alarm(const CameraConfig& config, double rate_hz, double open_s) {
  constexpr double kMostOff = 0.15, kKnown_s = 5.0;
  const bool differs =
      open_s > kKnown_s && std::abs(rate_hz / config.frame_rate_hz - 1.0) > kMostOff;
  if (!differs) return std::nullopt;
  return alarm::camera_rate_differs(rate_hz, config.frame_rate_hz);
}

device::DeviceReport make_camera_report(const CameraConfig& config, const CameraFacts& facts,
                                        double now_s) {
  device::DeviceReport report;
  report.name = "camera";
  report.state = device_state(facts.state);
  report.text = facts.identity.empty() ? "" : facts.identity + ", ";
  report.text += config.pixel_format + " " + std::to_string(config.width_px) + "x" +
                 std::to_string(config.height_px) + printed(", %.1f Hz", facts.frame_rate_hz);
  if (facts.state != CameraState::kStreaming && !facts.last_error.empty())
    report.text = facts.last_error;
  report.serial = facts.serial;
  report.last_good_s = facts.last_frame_s;
  report.last_error = facts.last_error;
  report.errors = facts.errors;
  add_alarms(config, facts, now_s, report.alarms);
  // Frames have just stopped: the camera's thread will report it after its timeout.
  const auto silent_s = silence_s(config, facts, now_s);
  if (report.state == device::DeviceState::kOk && is_timed(config.trigger) && silent_s) {
    report.state = device::DeviceState::kFault;
    report.text = alarm::camera_no_frames(*silent_s).reason();
  }
  report.readings = {{"camera_exposure_us", facts.exposure.exposure_us},
                     {"camera_gain_dB", facts.exposure.gain_dB},
                     {"camera_frame_rate_hz", facts.frame_rate_hz},
                     {"camera_clock_sd_s", facts.stamp_sd_s}};
  if (facts.temperature_degC) report.readings["camera_degC"] = *facts.temperature_degC;
  const CameraCounters& c = facts.counters;
  report.counters = {
      {"frames_captured", c.frames_captured},     {"frames_lost", c.frames_lost},
      {"frames_incomplete", c.frames_incomplete}, {"frames_late", c.frames_late},
      {"frames_refused", c.frames_refused},       {"camera_reconnects", c.reconnects}};
  report.readings.insert(facts.kind_readings.begin(), facts.kind_readings.end());
  report.counters.insert(facts.kind_counters.begin(), facts.kind_counters.end());
  return report;
}

}  // namespace ols::camera
