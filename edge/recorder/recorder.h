// Stores the raw frames around an event, on request. It consists of a ring buffer in memory and a
// thread that writes. A frame never waits for the disk. A full or read-only disk is reported, and
// affects only the recording.
//
// Each event is one folder FOLDER/<UTC>_<label>/ with PNG frames named by utime, and frames.csv.
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
  double memory_s = 5.0;  // how long frames are kept in memory, for the time before an event
  double memory_max_bytes = 256e6;
  double quota_bytes = 4e9;  // for all events together
  // In each interval of this length, at most one event is removed to make room, and only one that
  // is older than the interval. Otherwise, recordings that do not fit are refused. The default is
  // one day, because a site and its alarms are checked that often.
  double protect_s = 86400.0;
  double disk_reserve_bytes = 1e9;  // this much is always left free on the disk
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

  // Takes a frame into the memory (shares its pixels); never waits. `utime_us`: its mid-exposure.
  void add(const camera::Frame& frame, std::int64_t utime_us);
  // Returns empty if the command is accepted, otherwise the reason for the refusal.
  std::string record(const RecordCommand& command);
  device::DeviceReport report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::recorder
