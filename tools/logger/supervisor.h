// Keeps lcm-logger running, within its quota, and off a disk that is full or cannot be written.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "tools/logger/child_logger.h"
#include "tools/logger/log_folder.h"
#include "tools/logger/logger_config.h"

namespace ols {

struct LoggerStatus {
  bool recording = false;
  std::string text;    // the file that is written; or why none is
  int logger_pid = 0;  // of lcm-logger; 0: none
  std::size_t files = 0;
  double bytes = 0.0, free_bytes = 0.0;
  std::uint64_t starts = 0;  // of lcm-logger
  std::uint64_t failures =
      0;                      // ends of it that nobody asked for, and disks that were not to be had
  std::uint64_t removed = 0;  // files
  std::uint64_t dropped = 0;  // messages that the disk was too slow for
};

// JSON, one line.
std::string to_json(const LoggerStatus& status, std::int64_t utime_us);

class Supervisor {
 public:
  explicit Supervisor(const LoggerConfig& config);
  ~Supervisor();

  // A few times a second. `now_s`: CLOCK_MONOTONIC.
  void turn(double now_s);
  LoggerStatus status() const;

 private:
  void look_after_child(double now_s);
  void start(double now_s);
  void fail(const std::string& why, double retry_s);

  const LoggerConfig config_;
  LogFolder folder_;
  std::unique_ptr<ChildLogger> child_;
  std::string trouble_;  // why nothing is recorded; empty while lcm-logger runs
  double started_s_ = 0.0;
  double retry_s_ = 0.0;  // not started again before
  double pause_s_;
  std::uint64_t starts_ = 0, failures_ = 0, dropped_ = 0;
};

}  // namespace ols
