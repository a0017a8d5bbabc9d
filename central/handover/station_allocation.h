// Decides to which target each station is led. Pure.
//
//  - A station whose tracker follows a target stays with it. - A station that sees its target only
//    with its detector may be led to a target in need, if two good stations remain at its own
//    target.
//  - Every target first gets two stations whose lines of sight cross well. - Pairs of target and
//    station are served in the order of priority divided by the time to turn there, the highest
//    first.
//  - The remaining stations stay where they were led, or go to the target with the fewest
//    stations.
//  - A station that was led to a target stays there for at least 3 s. - After that it leaves only
//    for a target in need. - If its own target is in need as well, the other target must score
//    clearly higher.
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
  double priority = 1.0;  // > 0
};

struct AllocatedStation {
  std::string name;
  Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
  std::optional<AzimuthElevation> axis{};  // direction in which its camera looks
  bool is_led = true;  // false: the station is never led, but still counts at a target that it sees
  std::int64_t sees = 0;     // the target that it sees; 0 if none
  bool by_detector = false;  // only its detector sees the target, not its tracker
  std::int64_t led_to = 0;   // the target to which it was led and which it has not seen yet
  double led_s = 0.0;        // time since it was led there
};

// For each station that has a target: the target's id, by station name.
using Allocation = std::map<std::string, std::int64_t>;
Allocation allocate(std::span<const AllocatedTarget> targets,
                    std::span<const AllocatedStation> stations, const LineSearchConfig& unit);

}  // namespace ols::fusion
