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
  std::string name = "site";  // files are NAME-<UTC>.lcmlog.NN
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string channels = ".*";  // regular expression
  bool invert = false;          // records all channels except those that match
  double split_bytes = 100e6;   // a larger file is ended, and a new one begins
  double quota_bytes = 20e9;    // of all files together: the oldest are removed
  double disk_reserve_bytes = 2e9;
  double max_unwritten_mb = 50.0;  // in memory, while the disk is slow; further messages are lost
  std::string status_file;         // rewritten again and again, as JSON; empty: no file
  trust::TrustConfig trust{};
};

config::Section logger_section(LoggerConfig& config);  // the whole file
// Throws ConfigError.
LoggerConfig load_logger_config(const std::string& path);
// The same from text. Errors give `name` instead of the path.
LoggerConfig parse_logger_config(const std::string& text, const std::string& name);

}  // namespace ols::logger
