// The files that ols-setup will write, and the units that it will start. Pure.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/answers.h"

namespace ols::setup {

struct PlannedFile {
  std::string path;  // from the root of the file system
  std::string text;
  bool is_toml = true;
  // A line of the file as another package installs it. While the file contains this line, nobody
  // has configured it, and setup may replace it. Empty: no package installs the file.
  std::string unchosen{};
};

struct Plan {
  std::vector<PlannedFile> files;
  std::vector<std::string> units;  // to enable, in the order of their start
};

// Throws ConfigError, or std::invalid_argument naming an answer without a place in the file.
Plan plan_station(const Answers& answers);
struct Installed {
  bool fusion = true, console = true;
};
Plan plan_centre(const Answers& answers, Installed installed);

// The mount's device in the answers, as TOML, under either name of its section. Empty: none.
std::string mount_device(const Values& values);
// False: `ols-setup` has to search for the device. It finds GigE Vision and ONVIF cameras, and
// FLIR's units.
bool has_camera(const Values& values);
bool has_mount(const Values& values);
// The answers want an ONVIF camera, and do not say where its pictures or its motion are:
// kind = "rtsp" or "onvif" without `url`.
bool wants_onvif(const Values& values);

// Adds a found value as if it were an answer. Never replaces an answer.
void add(Values& values, const std::string& key, const std::string& text);

}  // namespace ols::setup
