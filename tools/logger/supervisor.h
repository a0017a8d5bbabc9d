// Keeps a recording running within the quota; pauses it while the disk is full or not writable.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tools/logger/bus_recorder.h"
#include "tools/logger/log_folder.h"
#include "tools/logger/logger_config.h"

namespace ols::logger {

struct LoggerStatus {
  bool recording = false;
  std::string text;  // the file being written, or why nothing is recorded
  std::size_t files = 0;
  double bytes = 0.0, free_bytes = 0.0;
  std::string bus_alarm;         // alarm of the bus monitor
  std::uint64_t starts = 0;      // number of started recordings
  std::uint64_t failures = 0;    // recordings that failed to start or ended by themselves
  std::uint64_t removed = 0;     // files removed because of the quota
  std::uint64_t files_lost = 0;  // files that were deleted, renamed or replaced during writing
  std::uint64_t dropped = 0;     // messages lost because the disk was too slow
  std::uint64_t fragments = 0;   // refused: fragments of messages
  std::uint64_t malformed = 0;   // refused: not LCM, or with an invalid channel name
};

// The status as one line of JSON.
std::string to_json(const LoggerStatus& status, std::int64_t utime_us);

class Supervisor {
 public:
  explicit Supervisor(const LoggerConfig& config);
  ~Supervisor();

  // Call a few times a second. `now_s`: CLOCK_MONOTONIC.
  void turn(double now_s);
  LoggerStatus status() const;

 private:
  void look_after_recorder(double now_s);
  void end_recorder();
  void start(double now_s);
  void fail(const std::string& why, double retry_s);

  const LoggerConfig config_;
  LogFolder folder_;
  std::unique_ptr<BusRecorder> recorder_;
  std::string trouble_;  // why nothing is recorded; empty while recording
  double started_s_ = 0.0;
  double retry_s_ = 0.0;  // time of the earliest next start
  double pause_s_;
  std::uint64_t starts_ = 0, failures_ = 0;
  LoggerStatus ended_;  // totals of earlier recordings
};

}  // namespace ols::logger
