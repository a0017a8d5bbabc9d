// Writes bus messages into an LCM log that lcm-logplayer and lcm-spy read.
#pragma once

#include <lcm/eventlog.h>

#include <cstdint>
#include <memory>
#include <string>

#include "base/bus_inbox.h"

namespace ols {

class LogWriter {
 public:
  // Makes the file; throws std::system_error that names it, also when it is there already.
  explicit LogWriter(const std::string& path);

  // Both throw std::system_error that names the file, when the disk does not take it.
  void write(const BusMessage& message);
  void flush();

  const std::string& path() const { return path_; }
  std::uint64_t bytes() const { return bytes_; }
  // Whether what is written can still be found under its name: a file that was deleted, renamed or
  // replaced takes everything, and nobody will read it.
  bool is_in_place() const;

 private:
  struct Close {
    void operator()(lcm_eventlog_t* log) const { lcm_eventlog_destroy(log); }
  };
  std::string path_;
  std::unique_ptr<lcm_eventlog_t, Close> log_;
  std::uint64_t bytes_ = 0;
};

}  // namespace ols
