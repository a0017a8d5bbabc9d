#include "tools/logger/logger_config.h"

#include "base/bus/channel_pattern.h"
#include "base/config/config_common.h"

namespace ols::logger {
namespace {

// Space for the current and the next file besides the kept ones.
constexpr double kLeastSplits = 4.0;

}  // namespace

config::Section logger_section(LoggerConfig& c) {
  return {"",
          "",
          {config::text("folder", c.folder, "Folder of the logs.", config::not_empty),
           config::text("name", c.name,
                        "Files are NAME-<UTC>.lcmlog.NN; no other file is ever removed.",
                        config::word_up_to(40)),
           config::bus_url(c.lcm_url),
           config::text("channels", c.channels, "Channels to record, a regular expression.",
                        [](const std::string& pattern) { ChannelPattern{pattern}; }),
           config::flag("invert", c.invert, "Records all channels but those."),
           config::number("split_mb", c.split_bytes, {0.01, 1e4}, config::kMegabytes,
                          "Size at which a new file is begun."),
           config::number("quota_gb", c.quota_bytes, {1e-5, 1e5}, config::kGigabytes,
                          "Maximum size of all files, at least four times split_mb; the oldest are "
                          "removed."),
           config::number("disk_reserve_gb", c.disk_reserve_bytes, {0.0, 1e5}, config::kGigabytes,
                          "With less free space the oldest files are removed; then recording "
                          "pauses."),
           config::number("max_unwritten_mb", c.max_unwritten_mb, {0.1, 1e4}, "MB",
                          "Maximum size in memory while the disk is slow; more is lost and "
                          "counted."),
           config::status_file(c.status_file)},
          {trust::trust_section(c.trust)},
          [&c](ConfigTable& root) {
            if (c.quota_bytes < kLeastSplits * c.split_bytes)
              throw root.error("quota_gb", "must be at least four times split_mb");
          }};
}

LoggerConfig load_logger_config(const std::string& path) {
  return config::load(path, logger_section);
}

LoggerConfig parse_logger_config(const std::string& text, const std::string& name) {
  return config::parse(text, name, logger_section);
}

}  // namespace ols::logger
