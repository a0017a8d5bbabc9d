#include "edge/tracker/tracker_config.h"

#include "base/config/config_section.h"

namespace ols::tracker {

config::Section tracker_section(TrackerConfig& c) {
  return {
      "tracker",
      "The visual tracker.",
      {config::word("mode", c.mode, {{"full", TrackerMode::kFull}, {"paper", TrackerMode::kPaper}},
                    "full, or the paper's section 5 word for word."),
       config::integer("particles", c.particles, 20, 20000, "",
                       "Particles of the filter: accuracy against processor time."),
       config::number("initial_velocity_sd_px_s", c.initial_velocity_sd_px_s, {0.0, 10000.0},
                      "px/s", "1-sigma of a new target's velocity in the image."),
       config::number("leap_most_px_s", c.leap_most_px_s, {0.0, 100000.0}, "px/s",
                      "Maximum speed in the image of a target that is searched for by motion."),
       config::number("learning_time_s", c.learning_time_s, {0.01, 1e6}, "s",
                      "Time constant of learning the template."),
       config::number("search_sd_most_px", c.search_sd_most_px, {1.0, 10000.0}, "px",
                      "Maximum 1-sigma of the region searched after a loss.")}};
}

}  // namespace ols::tracker
