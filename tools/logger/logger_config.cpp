#include "tools/logger/logger_config.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "base/channel_pattern.h"
#include "base/lcm_url.h"
#include "base/toml_config.h"

namespace ols {
namespace {

// Room for the file that is written and for the next, beside what is kept.
constexpr double kLeastSplits = 4.0;

void check_name(ConfigTable& table, const std::string& name) {
  const bool good =
      !name.empty() && name.size() <= 40 && std::ranges::all_of(name, [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_';
      });
  if (!good) throw table.error("name", "may have 40 letters, digits, - and _");
}

void check_channels(ConfigTable& table, const std::string& channels) {
  try {
    ChannelPattern{channels};
  } catch (const std::invalid_argument& problem) {
    throw table.error("channels", problem.what());
  }
}

LoggerConfig read(ConfigFile& file) {
  LoggerConfig c;
  ConfigTable& root = file.root();
  c.folder = root.text("folder", c.folder);
  if (c.folder.empty()) throw root.error("folder", "must not be empty");
  c.name = root.text("name", c.name);
  check_name(root, c.name);
  c.lcm_url = read_lcm_url(root, "lcm_url", c.lcm_url);
  c.channels = root.text("channels", c.channels);
  check_channels(root, c.channels);
  c.invert = root.boolean("invert", c.invert);
  c.split_bytes = 1e6 * root.number("split_mb", c.split_bytes * 1e-6, 0.01, 1e4);
  c.quota_bytes = 1e9 * root.number("quota_gb", c.quota_bytes * 1e-9, 1e-5, 1e5);
  c.disk_reserve_bytes =
      1e9 * root.number("disk_reserve_gb", c.disk_reserve_bytes * 1e-9, 0.0, 1e5);
  c.max_unwritten_mb = root.number("max_unwritten_mb", c.max_unwritten_mb, 0.1, 1e4);
  c.status_file = root.text("status_file", c.status_file);
  file.finish();
  if (c.quota_bytes < kLeastSplits * c.split_bytes) {
    throw root.error("quota_gb", "must be four times split_mb at least");
  }
  return c;
}

}  // namespace

LoggerConfig load_logger_config(const std::string& path) {
  ConfigFile file(path);
  return read(file);
}

LoggerConfig parse_logger_config(const std::string& text, const std::string& name) {
  ConfigFile file(text, name);
  return read(file);
}

}  // namespace ols
