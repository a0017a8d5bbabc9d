// What ols-setup is going to write and to start. Pure.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/answers.h"

namespace ols::setup {

struct PlannedFile {
  std::string path;  // from the root of the file system
  std::string text;
  bool is_toml = true;
  // A line of the file that its package installs, in which nobody has chosen anything yet.
  std::string unchosen{};
};

struct Plan {
  std::vector<PlannedFile> files;
  std::vector<std::string> units;  // to enable, in the order of their start
};

// Throws ConfigError, or std::invalid_argument naming an answer that has no place in the file.
Plan plan_station(const Answers& answers);
struct Installed {
  bool fusion = true, console = true;
};
Plan plan_centre(const Answers& answers, Installed installed);

// The answer to one question more: what was found. Replaces none.
void add(Values& values, const std::string& key, const std::string& text);

}  // namespace ols::setup
