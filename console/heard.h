// What the console hears on the bus, translated for its site model.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
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

// How pictures are coded: each by itself, or each by what has changed since the one before.
enum class Codec { kJpeg, kH264 };

struct Picture {
  std::string station;
  Json header;  // docs/console.md lists it
  std::string bytes;
  bool is_video = false;  // from the station's video socket, not the bus's preview
  Codec codec = Codec::kJpeg;
  bool is_key = false;  // of H.264: it can be shown without those before it
};

// Of H.264: so often a key frame is asked for, at which a browser begins that has missed something.
inline constexpr int kUnitsOfKeyFrame = 90;

// A station's video that somebody looks at.
struct WatchedVideo {
  std::string station;
  Codec codec = Codec::kJpeg;
  auto operator<=>(const WatchedVideo&) const = default;
};
// Where each is to be had: "10.0.0.11:7790".
using WatchedVideos = std::map<WatchedVideo, std::string>;

}  // namespace ols::console
