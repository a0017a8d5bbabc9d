// The camera's state, and the report about it in the station's status message. Pure.
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
  kAbsent,     // not found yet, or lost; the station tries again
  kStarting,   // opened, but no frame yet
  kStreaming,  // frames arrive
  // Found, but its frames or settings differ from the configuration; the station tries again.
  kFault,
};

struct CameraCounters {                 // they only increase
  std::uint64_t frames_captured = 0;    // complete frames with the configured size and format
  std::uint64_t frames_lost = 0;        // frames whose numbers are missing
  std::uint64_t frames_incomplete = 0;  // frames with missing packets
  // Captured frames that a newer one replaced before next() returned them.
  std::uint64_t frames_late = 0;
  std::uint64_t frames_refused = 0;  // frames of wrong size or format
  // Number of times that the camera was opened again, after the first time.
  std::uint64_t reconnects = 0;
};

// The facts from which the report is made.
struct CameraFacts {
  CameraState state = CameraState::kAbsent;
  CameraCounters counters;
  std::string last_error;    // the last error as text; empty if there was none
  std::uint64_t errors = 0;  // number of errors so far

  std::string identity;  // for example "AVT GT1290C 1234"; empty before the camera is opened
  std::string serial;    // as the camera states it
  Alarm fault;           // empty if there is no fault
  std::optional<double> last_frame_s;  // CLOCK_MONOTONIC of the last complete frame's arrival
  std::optional<double> opened_s;      // CLOCK_MONOTONIC when the camera was last opened
  double frame_rate_hz = 0.0;          // over the last five seconds
  double incomplete_share = 0.0;       // over the last five seconds
  ExposureSetting exposure;
  double missing_light = 1.0;  // AutoExposure::missing_factor()
  std::optional<double> temperature_degC;
  StampSource stamp_source = StampSource::kCamera;
  double stamp_sd_s = 0.0;
  std::optional<PtpState> ptp;  // set if PTP is configured
  std::optional<double> ptp_disagreement_s;
  // Data that only some kinds of cameras report.
  std::vector<Alarm> kind_alarms;
  std::map<std::string, double> kind_readings;
  std::map<std::string, std::uint64_t> kind_counters;
};

// If the share of incomplete frames among the recent ones is larger than this, the camera is
// reported as faulty.
inline constexpr double kManyIncomplete = 0.02;

// The alarm about a wrong frame rate. `open_s`: time since the camera was opened. nullopt if the
// rate is about the configured one, or not known yet.
std::optional<Alarm> rate_alarm(const CameraConfig& config, double rate_hz, double open_s);

device::DeviceReport make_camera_report(const CameraConfig& config, const CameraFacts& facts,
                                        double now_s);

}  // namespace ols::camera
