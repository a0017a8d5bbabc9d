// One recording: a connection to the bus, a thread that writes what comes into logs.
//
// lcm-logger is not used: its liblcm dies of a forged fragment (base/bus_datagram.h), and it goes
// on writing into a file that was deleted under its hands.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "base/bus_monitor.h"
#include "base/lcm_bus.h"
#include "tools/logger/log_names.h"
#include "tools/logger/log_writer.h"
#include "tools/logger/logger_config.h"

namespace ols {

struct RecorderReport {
  std::string file;                  // that is written now
  std::optional<std::string> ended;  // why nothing is written any more
  std::uint64_t messages = 0;        // written
  std::uint64_t dropped = 0;         // that the disk was too slow for
  std::uint64_t files_lost = 0;      // deleted, renamed or replaced while they were written
  std::string bus_alarm;             // what a person should know of the bus
  BusTraffic traffic;
};

class BusRecorder {
 public:
  // With `file` all goes into that one; otherwise into new ones in the configured folder. Throws
  // BusError, or std::system_error when the first file cannot be made.
  explicit BusRecorder(const LoggerConfig& config, const std::string& file = "");
  // What waits is written, unless it is discarded.
  ~BusRecorder();
  // The disk has no room for what waits.
  void discard() { discard_ = true; }

  RecorderReport report() const;

 private:
  void run();
  void record();
  void write(const BusMessage& message);
  void write_rest();
  void look_after_file();
  void begin_file();
  void look_at_bus(double now_s);

  const LoggerConfig config_;
  const std::string single_file_;
  LogNames names_;
  std::optional<LogWriter> writer_;  // of the thread alone
  BusMonitor watch_;                 // likewise
  double flush_due_s_ = 0.0, look_due_s_ = 0.0;

  mutable std::mutex mutex_;
  RecorderReport report_;
  std::atomic<bool> end_ = false, discard_ = false;
  LcmBus bus_;
  std::thread thread_;
};

}  // namespace ols
