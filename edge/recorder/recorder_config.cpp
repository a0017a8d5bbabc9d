#include "edge/recorder/recorder.h"

namespace ols {

RecorderConfig read_recorder_config(ConfigTable& table) {
  RecorderConfig c;
  c.folder = table.text("folder", c.folder);
  c.memory_s = table.number("memory_s", c.memory_s, 0.0, 600.0);
  c.memory_max_bytes = 1e6 * table.number("memory_max_mb", c.memory_max_bytes * 1e-6, 1.0, 1e5);
  c.quota_bytes = 1e9 * table.number("quota_gb", c.quota_bytes * 1e-9, 0.001, 1e5);
  c.protect_s = table.number("protect_s", c.protect_s, 60.0, 1e8);
  c.disk_reserve_bytes =
      1e9 * table.number("disk_reserve_gb", c.disk_reserve_bytes * 1e-9, 0.0, 1e5);
  c.event_max_s = table.number("event_max_s", c.event_max_s, 0.1, 3600.0);
  return c;
}

}  // namespace ols
