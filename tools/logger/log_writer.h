// Writes bus messages into an LCM log that lcm-logplayer and lcm-spy can read.
#pragma once

#include <lcm/eventlog.h>

#include <cstdint>
#include <memory>
#include <string>

#include "base/bus/bus_inbox.h"

namespace ols::logger {

class LogWriter {
 public:
  // Creates the file. Throws std::system_error naming the file; it must not exist yet.
  explicit LogWriter(const std::string& path);

  // write() and flush() throw std::system_error naming the file if writing fails.
  void write(const BusMessage& message);
  void flush();

  const std::string& path() const { return path_; }
  std::uint64_t bytes() const { return bytes_; }
  // Whether the open file is still at its path. Writing to a deleted, renamed or replaced file
  // gives no error, but the data are lost.
  bool is_in_place() const;

 private:
  struct Close {
    void operator()(lcm_eventlog_t* log) const { lcm_eventlog_destroy(log); }
  };
  std::string path_;
  std::unique_ptr<lcm_eventlog_t, Close> log_;
  std::uint64_t bytes_ = 0;
};

}  // namespace ols::logger
