#include "edge/mount/driven/recent_positions.h"

#include <algorithm>

#include "edge/mount/driven/position_intake.h"

namespace ols::mount {
namespace {

constexpr double kWindow_s = 0.6;
constexpr double kLeastMotion_rad = radians(0.2);

}  // namespace

RecentPositions::RecentPositions(double sd_rad)
    : least_motion_rad_(std::max(kLeastMotion_rad, 4.0 * sd_rad)) {}

void RecentPositions::add(const PanTilt& angles, double time_s) {
  seen_.push_back({time_s, angles});
  while (time_s - seen_.front().time_s > kWindow_s) seen_.pop_front();
}

double RecentPositions::last_interval_s() const {
  return seen_.size() < 2 ? 0.0 : newest_s() - seen_[seen_.size() - 2].time_s;
}

bool RecentPositions::move_since(double time_s) const {
  return std::ranges::any_of(seen_, [&](const Seen& seen) {
    return seen.time_s > time_s && distance(seen.angles, newest()) > least_motion_rad_;
  });
}

}  // namespace ols::mount
