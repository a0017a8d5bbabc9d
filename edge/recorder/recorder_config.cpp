// The keys of [recorder].
#include "base/config/config_section.h"
#include "edge/recorder/recorder.h"

namespace ols::recorder {

config::Section recorder_section(RecorderConfig& c) {
  return {"recorder",
          "Recordings of the raw frames around an event.",
          {config::text("folder", c.folder, "Folder of the recordings; empty: none are made.")
               .required_with_section(),
           config::number("memory_s", c.memory_s, {0.0, 600.0}, "s",
                          "Time before an event whose frames are kept in memory."),
           config::number("memory_max_mb", c.memory_max_bytes, {1.0, 1e5}, config::kMegabytes,
                          "Maximum size of these frames, and again of those waiting for the disk."),
           config::number("quota_gb", c.quota_bytes, {0.001, 1e5}, config::kGigabytes,
                          "Maximum size of all recordings."),
           config::number("protect_s", c.protect_s, {60.0, 1e8}, "s",
                          "Once in this time an older event is removed to free space; otherwise "
                          "recordings are refused."),
           config::number("disk_reserve_gb", c.disk_reserve_bytes, {0.0, 1e5}, config::kGigabytes,
                          "With less free space on the disk nothing is written."),
           config::number("event_max_s", c.event_max_s, {0.1, 3600.0}, "s",
                          "Maximum duration of a recording.")}};
}

}  // namespace ols::recorder
