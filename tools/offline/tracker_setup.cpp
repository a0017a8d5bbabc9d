#include "tools/offline/tracker_setup.h"

#include "base/config_section.h"

namespace ols {

TrackerConfig load_tracker_config(const std::string& path, const std::string& mode) {
  TrackerConfig config;
  if (!path.empty()) {
    ConfigFile file(path);
    config::read({"", "", {}, {tracker_section(config)}}, file.root());
  }
  if (mode == "paper") config.mode = TrackerMode::kPaper;
  if (mode == "full") config.mode = TrackerMode::kFull;
  return config;
}

}  // namespace ols
