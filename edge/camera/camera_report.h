// How the camera is, in the words of the status message. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "edge/camera/camera_config.h"
#include "edge/camera/frame.h"
#include "edge/camera/ptp.h"
#include "edge/device_report.h"

namespace ols::camera {

enum class CameraState {
  kAbsent,     // not there yet, or lost; retried
  kStarting,   // opened, no frame yet
  kStreaming,  // frames arrive
  kFault,      // there, but what it sends or accepts is not what is configured; retried
};

struct CameraCounters {                 // only go up
  std::uint64_t frames_captured = 0;    // complete and of the configured size and format
  std::uint64_t frames_lost = 0;        // missing from the camera's own numbering
  std::uint64_t frames_incomplete = 0;  // packets missing
  std::uint64_t frames_late = 0;        // captured, but a newer one was there before next() came
  std::uint64_t frames_refused = 0;     // wrong size or format
  std::uint64_t reconnects = 0;         // opened again after it had streamed or failed
};

// What the camera's thread knows.
struct CameraFacts {
  CameraState state = CameraState::kAbsent;
  CameraCounters counters;
  std::string last_error;    // the last trouble in words; empty when there was none
  std::uint64_t errors = 0;  // troubles so far

  std::string identity;                // "AVT GT1290C 1234"; empty before it was opened
  std::string fault;                   // why it is a fault; empty when it is none
  std::optional<double> last_frame_s;  // CLOCK_MONOTONIC of the last complete frame's arrival
  std::optional<double> opened_s;      // of the last opening
  double frame_rate_hz = 0.0;          // of late
  double incomplete_share = 0.0;       // of late
  ExposureSetting exposure;
  double missing_light = 1.0;  // factor that automatic exposure wants and the limits do not allow
  std::optional<double> temperature_degC;
  StampSource stamp_source = StampSource::kCamera;
  double stamp_sd_s = 0.0;
  std::optional<PtpState> ptp;  // where it was asked for
  std::optional<double> ptp_disagreement_s;
};

station::DeviceReport make_camera_report(const CameraConfig& config, const CameraFacts& facts,
                                         double now_s);

}  // namespace ols::camera
