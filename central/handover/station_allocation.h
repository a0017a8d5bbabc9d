// Which target each station is led to. Pure.
//
//  - A station whose tracker follows a target stays with it. A station that sees its target only by
//    its detector may be led to a target in need, if two good stations remain at its own.
//  - Every target first gets two stations whose lines of sight cross well. Pairs of target and
//    station are served by priority over the time to turn there, the highest first.
//  - The stations that are left stay where they were led, or go to the target with the fewest
//    stations.
//  - A station that was led to a target stays for 3 s. Later it leaves only for a target in need.
//    If its own target is in need as well, the other must score clearly higher.
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
  std::optional<AzimuthElevation> axis{};  // where its camera looks
  bool is_led = true;        // false: never led; it still counts at a target that it sees
  std::int64_t sees = 0;     // the target that it sees; 0: none
  bool by_detector = false;  // it sees it only by its detector
  std::int64_t led_to = 0;   // the target that it was led to and has not seen yet
  double led_s = 0.0;        // since it was led there
};

// The target of each station that has one, by name.
using Allocation = std::map<std::string, std::int64_t>;
Allocation allocate(std::span<const AllocatedTarget> targets,
                    std::span<const AllocatedStation> stations, const LineSearchConfig& unit);

}  // namespace ols::fusion
