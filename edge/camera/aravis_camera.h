// A GigE Vision camera through Aravis, opened and kept open by a thread of its own.
//
// The camera may be absent, vanish and come back at any time: next() then simply has no frame, and
// state(), counters() and last_error() say why. After construction nothing throws.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "edge/camera/camera_config.h"
#include "edge/camera/frame.h"

namespace ols {

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

class AravisCamera {
 public:
  // Starts to look for the camera and returns at once.
  explicit AravisCamera(const CameraConfig& config);
  ~AravisCamera();
  AravisCamera(const AravisCamera&) = delete;
  AravisCamera& operator=(const AravisCamera&) = delete;

  // The newest frame that has not been handed out yet, waiting up to timeout_s for one.
  std::optional<Frame> next(double timeout_s);

  CameraState state() const;
  CameraCounters counters() const;
  std::string last_error() const;  // the last trouble in words; empty when there was none

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols
