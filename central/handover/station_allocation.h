// Decides to which target each station is led. Pure.
//
// Every target gets a good pair: two stations whose lines of sight cross at a good angle. 20
// degrees or more are good. A smaller angle is also good if its sine is at least half of the sine
// for the best pair that the site has for this target. All other stations are free.
//
//  - A station that sees a target can be spared if the other stations that see this target include
//    a good pair. A station that cannot be spared leaves its target only if another target has 1.5
//    times the priority, and the stations that can be spared give that other target no good pair.
//    If an operator wants a target, all stations whose trackers follow it stay there. Any other
//    station may be moved.
//  - Targets without a good pair come first. Each possible move of a station to such a target has a
//    score: the target's priority, divided by (0.5 s + the time to turn there). The move with the
//    highest score is made first. A station that is on its way to a target counts as being there.
//  - After these moves, one station searches along the line of sight of an object whose position is
//    unknown. If there is no target, all stations search there.
//  - Each remaining station goes to the target with the highest value of priority divided by number
//    of stations, counting itself. A station leaves its present target only for another one whose
//    value is 1.5 times as high.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "central/handover/line_search.h"
#include "geometry/direction.h"

namespace ols::fusion {

struct AllocatedTarget {
  std::int64_t id = 0;
  Eigen::Vector3d p_ecef = Eigen::Vector3d::Zero();
  double priority = 1.0;        // > 0
  bool keeps_trackers = false;  // an operator wants it
};

struct AllocatedStation {
  std::string name;
  Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
  std::optional<AzimuthElevation> axis{};  // direction in which its camera looks
  bool is_led = true;          // false: never led, but counted at the target that it sees
  std::int64_t sees = 0;       // the target that it sees; 0 if none
  bool by_detector = false;    // its detector sees the target, its tracker does not
  bool keeps_tracker = false;  // an operator designated the target here: the station stays
  std::int64_t led_to = 0;     // the target to which it is being led and which it does not see yet
  bool is_busy = false;        // its tracker follows an object that is not a target yet
  bool may_search = true;      // false: it already sees the object of the line
  bool searches = false;       // it is already searching along that line
};

// Station name to target id, for the stations that are led. kOnLine: the station searches along the
// line of sight instead.
inline constexpr std::int64_t kOnLine = 0;
using Allocation = std::unordered_map<std::string, std::int64_t>;
// `unit`: how fast the units turn. `line_ecef`: the most likely position of the object of which
// only a line of sight is known.
Allocation allocate(std::span<const AllocatedTarget> targets,
                    std::span<const AllocatedStation> stations, const LineSearchConfig& unit,
                    const std::optional<Eigen::Vector3d>& line_ecef = std::nullopt);

}  // namespace ols::fusion
