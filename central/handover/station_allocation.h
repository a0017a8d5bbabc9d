// Decides to which target each station is led. Pure.
//
// Every target gets two stations whose lines of sight cross well (a good pair): at 20 degrees or
// more, or with at least half the sine of the best pair that the site has for it. All other
// stations are free.
//
//  - The good pair of a target consists of stations that see it. A station that sees a target can
//    be spared if the other stations that see the target include a good pair. A station that cannot
//    be spared leaves its target only for another one with 1.5 times the priority, and only if
//    spared stations give that other target no good pair. An operator's target keeps all of its
//    trackers. Any other station may be moved.
//  - Targets without a good pair come first. Pairs of target and station are served in the order of
//    priority divided by (0.5 s + time to turn there), the highest first. A station that is on its
//    way to a target counts as being there.
//  - Then one station searches along the line of sight of an object that has no position. If there
//    is no target, all stations search.
//  - The remaining stations go where the priority, divided by the number of stations there, is
//    highest. A station leaves its present target only for another one where this value is 1.5
//    times as high.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
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
  bool is_led = true;          // false: never led, but counts at the target that it sees
  std::int64_t sees = 0;       // the target that it sees; 0 if none
  bool by_detector = false;    // only its detector sees the target, not its tracker
  bool keeps_tracker = false;  // an operator has started its tracker there: it is not lent
  std::int64_t led_to = 0;     // the target to which it was led and which it has not seen yet
  bool is_busy = false;        // its tracker follows an object that is no target yet
  bool may_search = true;      // false: it sees the object on the line itself
  bool searches = false;       // it has been led along that line
};

// For each station that has a target: the target's id, by station name. kOnLine: it searches along
// the line instead.
inline constexpr std::int64_t kOnLine = 0;
using Allocation = std::map<std::string, std::int64_t>;
// `line_ecef`: the likeliest place of an object of which only a line of sight is known.
Allocation allocate(std::span<const AllocatedTarget> targets,
                    std::span<const AllocatedStation> stations, const LineSearchConfig& unit,
                    const std::optional<Eigen::Vector3d>& line_ecef = std::nullopt);

}  // namespace ols::fusion
