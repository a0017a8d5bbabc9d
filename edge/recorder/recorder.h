// Records the raw frames before and after an event, on request. A ring buffer in memory keeps the
// newest frames, and a thread writes. add() never waits for the disk. A full or read-only disk is
// reported and affects nothing but the recording.
//
// Each event has a folder FOLDER/<UTC>_<label>/, as described in event_folder.h.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "edge/camera/frame.h"
#include "edge/device/device_report.h"

namespace ols::config {
struct Section;
}
namespace ols::recorder {

struct RecorderConfig {
  std::string folder;     // if empty, the station records nothing
  double memory_s = 5.0;  // length of the ring buffer, which contains the frames before an event
  double memory_max_bytes = 256e6;
  double quota_bytes = 4e9;  // limit for all events together
  // In any period of this length, at most one event is removed to make room; the event must be
  // older than this. Recordings that still do not fit are refused. The default is one day, because
  // people check a site and its alarms once a day.
  double protect_s = 86400.0;
  double disk_reserve_bytes = 1e9;  // free space that recordings always leave on the disk
  double event_max_s = 60.0;
};

config::Section recorder_section(RecorderConfig& config);  // the section [recorder]

struct RecordCommand {
  double event_s = 0.0;  // on the station's monotonic clock
  double before_s = 0.0, after_s = 0.0;
  std::string label;
};

class Recorder {
 public:
  explicit Recorder(const RecorderConfig& config);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // Takes a frame into the ring buffer, without copying its pixels; never waits. `utime_us`: UTC of
  // the frame's mid-exposure.
  void add(const camera::Frame& frame, std::int64_t utime_us);
  // Returns empty if the command is accepted, otherwise the reason for the refusal.
  std::string record(const RecordCommand& command);
  device::DeviceReport report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::recorder
