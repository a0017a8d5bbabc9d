// One recording: a bus connection, and a thread that writes its messages into logs.
//
// lcm-logger is not used: a forged fragment crashes its liblcm (base/bus/bus_datagram.h), and it
// keeps writing into a file that was deleted.
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
  std::string file;                  // being written
  std::optional<std::string> ended;  // why the recording ended
  std::uint64_t messages = 0;        // written
  std::uint64_t dropped = 0;         // lost because the disk was too slow
  std::uint64_t files_lost = 0;      // deleted, renamed or replaced while they were written
  std::string bus_alarm;             // of the bus monitor
  BusTraffic traffic;
};

class BusRecorder {
 public:
  // With `file`, records only into that file; otherwise into new ones in the configured folder.
  // Throws BusError, or std::system_error if the first file cannot be created.
  explicit BusRecorder(const LoggerConfig& config, const std::string& file = "");
  // Writes the waiting messages unless discard() was called.
  ~BusRecorder();
  // For a full disk: drops the waiting messages.
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
    // Numbers of the last list beside the logs and in the present file; used only by the thread.
    std::int64_t kept = 0, written = 0;
  };
  Lists lists_;
  LcmBus bus_;
  std::thread thread_;
};

}  // namespace ols::logger
