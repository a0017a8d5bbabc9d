// The contents of bus messages, as values for the console's model of the site.
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
  Json fields;  // listed in docs/console.md
  bool is_stopped = false;
  std::string video_address;  // address of its video socket; empty: it has none
  std::vector<Alarm> alarms;
  std::string last_error;
  std::int64_t last_error_utime_us = 0;
};

struct ReceivedTarget {
  enum class What { kPosition, kLine, kNoPosition, kDropped, kNothing };
  What what = What::kNothing;
  std::int64_t boot_id = 0;
  std::string id;  // id of the target; for a line: id of its station
  Json fields;
  double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
};

// The message by which the fusion tells a station that the land hides a target from it.
struct ReceivedOcclusion {
  std::string station;
  std::string target;  // the target's id
  bool is_hidden = false;
  std::int64_t utime_us = 0;
  std::int64_t back_us = 0;  // when the target is predicted to be visible again; 0: not known
  double holds_s = 0.0;      // how long the message is valid after it arrives; 0: it ends the
                             // previous message's validity
};

struct ReceivedFusion {
  std::int64_t boot_id = 0;
  Json fields;
  std::vector<Alarm> alarms;
  std::string last_error;
};

// How pictures are coded. kJpeg: each picture by itself. kH264: each picture as its changes from
// the picture before, except key frames.
enum class Codec { kJpeg, kH264 };

struct Picture {
  std::string station;
  Json header;  // listed in docs/console.md
  std::string bytes;
  bool is_video = false;  // from the station's video socket; false: a preview from the bus
  Codec codec = Codec::kJpeg;
  bool is_key = false;  // H.264: can be decoded without earlier pictures
};

// For H.264: after this many units (pictures), a key frame is requested, so that a browser that has
// lost units can continue from it.
inline constexpr int kUnitsOfKeyFrame = 90;

// A station's video that a viewer watches, and how it is coded.
struct WatchedVideo {
  std::string station;
  Codec codec = Codec::kJpeg;
  auto operator<=>(const WatchedVideo&) const = default;
};
// The watched videos with their addresses, such as "10.0.0.11:7790".
using WatchedVideos = std::map<WatchedVideo, std::string>;

}  // namespace ols::console
