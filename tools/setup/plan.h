// The files that ols-setup will write, and the systemd units that it will start. Pure.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/answers.h"

namespace ols::setup {

struct PlannedFile {
  std::string path;  // absolute
  std::string text;
  bool is_toml = true;
  // A line of the file as another package installs it. While the file contains this line, nobody
  // has configured it, and ols-setup may replace it. Empty: no package installs the file.
  std::string unchosen{};
};

struct Plan {
  std::vector<PlannedFile> files;
  std::vector<std::string> units;  // to enable, in the order of their start
};

// Throws ConfigError, or std::invalid_argument naming an answer that belongs to no configuration
// file.
Plan plan_station(const Answers& answers);
struct Installed {
  bool fusion = true, console = true;
};
Plan plan_centre(const Answers& answers, Installed installed);

// The mount's device in the answers, as TOML, from the section [mount] or [ptu]; empty: there is
// none.
std::string mount_device(const Values& values);
// Whether the answers name the device. If not, ols-setup searches for it (finders.h).
bool has_camera(const Values& values);
bool has_mount(const Values& values);
// Whether the answers want an ONVIF camera without its address: kind = "rtsp" or "onvif" without
// `url`.
bool wants_onvif(const Values& values);

// Adds a value that ols-setup has found, in the form of an answer. Never replaces an answer.
void add(Values& values, const std::string& key, const std::string& text);

}  // namespace ols::setup
