// The camera's state in the terms of the status message. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "edge/camera/camera_config.h"
#include "edge/camera/exposure.h"
#include "edge/camera/frame.h"
#include "edge/camera/ptp.h"
#include "edge/device/device_report.h"

namespace ols::camera {

enum class CameraState {
  kAbsent,     // not found yet, or lost; retried
  kStarting,   // opened, no frame yet
  kStreaming,  // frames arrive
  kFault,      // found, but its frames or settings are not as configured; retried
};

struct CameraCounters {                 // only rise
  std::uint64_t frames_captured = 0;    // complete and of the configured size and format
  std::uint64_t frames_lost = 0;        // missing in the camera's numbering
  std::uint64_t frames_incomplete = 0;  // packets missing
  std::uint64_t frames_late = 0;        // captured, but replaced by a newer one before next()
  std::uint64_t frames_refused = 0;     // wrong size or format
  std::uint64_t reconnects = 0;  // how often it was opened again after it had streamed or failed
};

// The state known to the camera's thread.
struct CameraFacts {
  CameraState state = CameraState::kAbsent;
  CameraCounters counters;
  std::string last_error;    // the last error as text; empty: none yet
  std::uint64_t errors = 0;  // errors so far

  std::string identity;                // "AVT GT1290C 1234"; empty before the first opening
  std::string serial;                  // as the camera says it
  Alarm fault;                         // empty: no fault
  std::optional<double> last_frame_s;  // CLOCK_MONOTONIC of the last complete frame's arrival
  std::optional<double> opened_s;      // of the last opening
  double frame_rate_hz = 0.0;          // recent
  double incomplete_share = 0.0;       // recent
  ExposureSetting exposure;
  double missing_light = 1.0;  // AutoExposure::missing_factor()
  std::optional<double> temperature_degC;
  StampSource stamp_source = StampSource::kCamera;
  double stamp_sd_s = 0.0;
  std::optional<PtpState> ptp;  // if configured
  std::optional<double> ptp_disagreement_s;
  // What only this kind of camera has to say.
  std::vector<Alarm> kind_alarms;
  std::map<std::string, double> kind_readings;
  std::map<std::string, std::uint64_t> kind_counters;
};

// If packets are missing in a larger share of the recent frames, the camera is faulty.
inline constexpr double kManyIncomplete = 0.02;

device::DeviceReport make_camera_report(const CameraConfig& config, const CameraFacts& facts,
                                        double now_s);

}  // namespace ols::camera
