#include "tools/offline/tracker_setup.h"

#include "base/config/config_section.h"

namespace ols::offline {

tracker::TrackerConfig load_tracker_config(const std::string& path, const std::string& mode) {
  tracker::TrackerConfig config;
  if (!path.empty()) {
    ConfigFile file(path);
    config::read({"", "", {}, {tracker::tracker_section(config)}}, file.root());
  }
  if (mode == "paper") config.mode = tracker::TrackerMode::kPaper;
  if (mode == "full") config.mode = tracker::TrackerMode::kFull;
  return config;
}

}  // namespace ols::offline
