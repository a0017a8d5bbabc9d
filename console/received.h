// Messages of the bus, translated into values for the console's model of the site.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "console/entity_table.h"

namespace ols::console {

struct ReceivedStation {
  std::string id;
  Json fields;  // docs/console.md lists them
  bool is_stopped = false;
  std::string video_address;  // where its video can be fetched; empty: nowhere
  std::vector<Alarm> alarms;
  std::string last_error;
  std::int64_t last_error_utime_us = 0;
};

struct ReceivedTarget {
  enum class What { kPosition, kLine, kNoPosition, kDropped, kNothing };
  What what = What::kNothing;
  std::int64_t boot_id = 0;
  std::string id;  // of the target; of a line: its station
  Json fields;
  double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
};

// The fusion's message to a station that the land hides a target from it.
struct ReceivedOcclusion {
  std::string station;
  std::string target;  // its id
  bool is_hidden = false;
  std::int64_t utime_us = 0;
  std::int64_t back_us = 0;  // when it comes out; 0: not known
  double holds_s = 0.0;      // validity, from the arrival; 0: the previous message no longer holds
};

struct ReceivedFusion {
  std::int64_t boot_id = 0;
  Json fields;
  std::vector<Alarm> alarms;
  std::string last_error;
};

// How pictures are coded: each one alone, or as changes of the one before.
enum class Codec { kJpeg, kH264 };

struct Picture {
  std::string station;
  Json header;  // listed in docs/console.md
  std::string bytes;
  bool is_video = false;  // from the station's video socket, not from the bus (preview)
  Codec codec = Codec::kJpeg;
  bool is_key = false;  // of H.264: can be decoded without earlier ones
};

// For H.264: a key frame is requested after this many units. A browser that has lost units can
// continue from a key frame.
inline constexpr int kUnitsOfKeyFrame = 90;

// A station's video that somebody watches, and how it is coded.
struct WatchedVideo {
  std::string station;
  Codec codec = Codec::kJpeg;
  auto operator<=>(const WatchedVideo&) const = default;
};
// The watched videos with their addresses, such as "10.0.0.11:7790".
using WatchedVideos = std::map<WatchedVideo, std::string>;

}  // namespace ols::console
