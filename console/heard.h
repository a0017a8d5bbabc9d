// What the console hears on the bus, translated for its site model.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "command/outcome.h"
#include "console/entity_table.h"

namespace ols::console {

struct StationHeard {
  std::string id;
  Json fields;  // docs/console.md lists them
  command::Reply reply;
  std::string video_address;  // where its pictures are to be had; empty: nowhere
  std::vector<std::string> alarms;
  std::string last_error;
  std::int64_t last_error_utime_us = 0;
};

struct TargetHeard {
  enum class What { kPosition, kLine, kNoPosition, kDropped, kNothing };
  What what = What::kNothing;
  std::int64_t boot_id = 0;
  std::string id;  // of the target; of a line: its station
  Json fields;
  double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
};

struct FusionHeard {
  std::int64_t boot_id = 0;
  Json fields;
  std::vector<std::string> alarms;
  std::string last_error;
};

struct Picture {
  std::string station;
  Json header;  // docs/console.md lists it
  std::string jpeg;
  bool is_video = false;  // from the station's video socket, not the bus's preview
};

}  // namespace ols::console
