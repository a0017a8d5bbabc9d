// One recording: a connection to the bus, and a thread that writes the messages into logs.
//
// LCM's own lcm-logger is not used: a forged fragment crashes liblcm (base/bus/bus_datagram.h), and
// lcm-logger continues to write into a file that was deleted.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "base/bus/bus_monitor.h"
#include "base/bus/lcm_bus.h"
#include "base/journal/alarm_journal.h"
#include "tools/logger/log_names.h"
#include "tools/logger/log_writer.h"
#include "tools/logger/logger_config.h"
#include "tools/logger/trust_lists.h"

namespace ols::logger {

struct RecorderReport {
  std::string file;                  // the file being written
  std::optional<std::string> ended;  // why the recording ended
  std::uint64_t messages = 0;        // number of messages written
  std::uint64_t dropped = 0;         // messages lost because the disk was too slow
  std::uint64_t files_lost = 0;      // files that were deleted, renamed or replaced during writing
  std::string bus_alarm;             // alarm of the bus monitor
  BusTraffic traffic;
};

class BusRecorder {
 public:
  // Records only into `file`, or, if `file` is empty, into new files in the configured folder.
  // Throws BusError, or std::system_error if the first file cannot be created.
  explicit BusRecorder(const LoggerConfig& config, const std::string& file = "");
  // Writes the messages in the queue, unless discard() was called.
  ~BusRecorder();
  // Call if the disk is full: discards the messages in the queue.
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
  void receive_trust_list(const BusMessage& received);
  void write_trust_lists(const BusMessage& next);
  void keep_beside(const ReceivedList& list);

  const LoggerConfig config_;
  const std::string single_file_;
  LogNames names_;
  std::optional<LogWriter> writer_;  // used only by the thread
  struct Watch {
    BusMonitor monitor;
    AlarmJournal journal;
  };
  Watch watch_;  // used only by the thread
  struct Due {
    double flush_s = 0.0, look_s = 0.0;
  };
  Due due_;

  mutable std::mutex mutex_;
  RecorderReport report_;
  std::atomic<bool> end_ = false, discard_ = false;
  std::shared_ptr<trust::BusTrust> trust_;
  struct Lists {
    TrustLists received;
    // Numbers of the last list stored beside the logs, and of the last list in the current file;
    // used only by the thread.
    std::int64_t kept = 0, written = 0;
  };
  Lists lists_;
  LcmBus bus_;
  std::thread thread_;
};

}  // namespace ols::logger
