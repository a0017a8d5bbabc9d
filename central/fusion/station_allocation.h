// Which target each station is led to. Pure.
//
//  - A station whose tracker follows a target stays with it. One that sees a target only by its
//    detector may be led to another that needs it more, if its own keeps two good stations.
//  - Every target first gets two stations whose lines of sight cross well. The pairs of target and
//    station are served in the order of worth over the time to turn there.
//  - The stations that are left stay where they were led, or go to the target that the fewest have.
//  - A station that was led to a target stays for a lease. Later it leaves it only for one that
//    needs it, and for a clearly better one if its own needs it, too.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "central/fusion/line_search.h"
#include "geometry/direction.h"

namespace ols::fusion {

struct AllocatedTarget {
  std::int64_t id = 0;
  Eigen::Vector3d p_ecef = Eigen::Vector3d::Zero();
  double worth = 1.0;  // > 0; existence times priority
};

struct AllocatedStation {
  std::string name;
  Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
  std::optional<AzimuthElevation> axis{};  // where its camera looks
  bool is_led = true;                      // false: it counts where it sees a target, no more
  std::int64_t sees = 0;                   // the target that it sees; 0: none
  bool by_detector = false;                // it sees it only by its detector
  std::int64_t led_to = 0;                 // the target that it was led to, and has not seen yet
  double led_s = 0.0;                      // for how long
};

// The target of each station that has one, by name.
using Allocation = std::map<std::string, std::int64_t>;
Allocation allocate(std::span<const AllocatedTarget> targets,
                    std::span<const AllocatedStation> stations, const LineSearchConfig& unit);

}  // namespace ols::fusion
