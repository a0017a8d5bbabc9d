// One running lcm-logger: started, listened to, stopped and reaped.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/logger/logger_config.h"

namespace ols {

// lcm-logger 1.3.1 documents -l and refuses it; --lcm-url works.
std::vector<std::string> logger_command(const LoggerConfig& config);

class ChildLogger {
 public:
  explicit ChildLogger(const std::vector<std::string>& command);  // throws std::system_error
  ~ChildLogger();                                                 // stops it
  ChildLogger(const ChildLogger&) = delete;
  ChildLogger& operator=(const ChildLogger&) = delete;

  // Lines that it wrote since the last call, without its summary of each second.
  std::vector<std::string> listen();
  // How it ended, in words; nothing while it runs.
  std::optional<std::string> ended();
  // Asks it to end, then makes it; returns when it is reaped.
  void stop();

  const std::string& current_file() const { return current_file_; }
  std::uint64_t dropped() const { return dropped_; }  // messages that it could not write
  pid_t pid() const { return pid_; }

 private:
  void take_line(const std::string& line, std::vector<std::string>& lines);
  bool reap(int flags);

  pid_t pid_ = -1;
  int output_ = -1;
  bool reaped_ = false;
  int status_ = 0;
  std::string pending_;  // of an unfinished line
  std::string current_file_;
  std::uint64_t dropped_ = 0;
};

}  // namespace ols
