// The contents of ols-logger's configuration file: docs/configuration.md.
#pragma once

#include <string>

#include "base/trust/trust_config.h"

namespace ols::config {
struct Section;
}
namespace ols::logger {

struct LoggerConfig {
  std::string folder = "/var/log/ols";
  std::string name = "site";  // NAME in the names of the files, NAME-<UTC>.lcmlog.NN
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string channels = ".*";  // regular expression
  bool invert = false;          // true: records all channels except those that match
  double split_bytes = 100e6;   // when a file is larger, a new file begins
  double quota_bytes = 20e9;    // of all files together; beyond it, the oldest files are removed
  double disk_reserve_bytes = 2e9;
  // Max size of the queue in memory; while it is full, messages are lost.
  double max_unwritten_mb = 50.0;
  std::string status_file;  // updated regularly, as JSON; empty: no file
  trust::TrustConfig trust{};
};

config::Section logger_section(LoggerConfig& config);  // the whole file
// Throws ConfigError.
LoggerConfig load_logger_config(const std::string& path);
// The same from the text of a file. In errors, `name` is in the place of the path.
LoggerConfig parse_logger_config(const std::string& text, const std::string& name);

}  // namespace ols::logger
