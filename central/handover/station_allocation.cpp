#include "central/handover/station_allocation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>

#include "geometry/angles.h"
#include "geometry/wgs84.h"

namespace ols::fusion {
namespace {

constexpr double kStay_s = 3.0;
constexpr double kKeep = 1.5;          // the score of the present target over its own
constexpr double kReact_s = 0.5;       // of every hand-over, besides the turn
constexpr double kGoodSine = 0.34;     // of two lines that cross at 20 degrees
constexpr std::size_t kCompared = 64;  // free stations, and targets in need, that are compared

class Allocator {
 public:
  Allocator(std::span<const AllocatedTarget> targets, std::span<const AllocatedStation> stations,
            const LineSearchConfig& unit)
      : targets_(targets), stations_(stations), unit_(unit), held_by_(targets.size()) {
    for (std::size_t i = 0; i < targets.size(); ++i) index_[targets[i].id] = i;
  }

  Allocation run() {
    for (std::size_t k = 0; k < stations_.size(); ++k) keep(k);
    serve_needs();
    for (const std::size_t k : free_) serve_rest(k);
    return allocation_;
  }

 private:
  struct Pair {
    double score = 0.0;
    std::size_t station = 0, target = 0;
  };
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::size_t index_of(std::int64_t id) const {
    const auto found = index_.find(id);
    return found == index_.end() ? kNone : found->second;
  }

  void give(std::size_t station, std::size_t target) {
    held_by_[target].push_back(station);
    if (stations_[station].is_led) allocation_[stations_[station].name] = targets_[target].id;
  }

  // Where it has to stay; else it is free, or may leave what only its detector sees.
  void keep(std::size_t k) {
    const AllocatedStation& station = stations_[k];
    const std::size_t seen = index_of(station.sees), led_to = index_of(station.led_to);
    if (seen != kNone && !(station.is_led && station.by_detector)) return give(k, seen);
    if (!station.is_led) return;
    if (led_to != kNone && station.led_s < kStay_s) return give(k, led_to);
    if (seen == kNone) return free_.push_back(k);
    give(k, seen);
    spare_.push_back(k);
  }

  Eigen::Vector3d line(std::size_t station, std::size_t target) const {
    return (targets_[target].p_ecef - stations_[station].camera_ecef).normalized();
  }

  // Whether two of the stations that have the target see it under a good angle. `with`, `without`:
  // one more, one less; kNone: none.
  bool is_served(std::size_t target, std::size_t with, std::size_t without) const {
    std::vector<std::size_t> all = held_by_[target];
    if (with != kNone) all.push_back(with);
    std::erase(all, without);
    for (std::size_t i = 0; i < std::min(all.size(), kCompared); ++i) {
      const Eigen::Vector3d one = line(all[i], target);
      for (std::size_t j = 0; j < i; ++j) {
        if (one.cross(line(all[j], target)).norm() >= kGoodSine) return true;
      }
    }
    return false;
  }

  double score(std::size_t k, std::size_t target) const {
    const AllocatedStation& station = stations_[k];
    const Eigen::Vector3d there = R_ecef_enu(station.camera_ecef).transpose() * line(k, target);
    const bool is_known = station.axis && !station.camera_ecef.isZero();
    const double turn_rad =
        is_known ? angle_between(there, enu_from_azimuth_elevation(*station.axis)) : kPi / 4.0;
    const std::int64_t id = targets_[target].id;
    const bool is_present = id == station.led_to || id == station.sees;
    return targets_[target].priority * (is_present ? kKeep : 1.0) /
           (kReact_s + turning_s(turn_rad, unit_));
  }

  std::vector<Pair> pairs() const {
    std::vector<std::size_t> needy;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      if (!is_served(i, kNone, kNone)) needy.push_back(i);
    }
    std::ranges::stable_sort(needy, std::greater{},
                             [&](std::size_t i) { return targets_[i].priority; });
    needy.resize(std::min(needy.size(), kCompared));
    std::vector<std::size_t> movable = free_;
    movable.insert(movable.end(), spare_.begin(), spare_.end());
    movable.resize(std::min(movable.size(), kCompared));
    std::vector<Pair> all;
    for (const std::size_t k : movable) {
      for (const std::size_t i : needy) {
        if (targets_[i].id != stations_[k].sees) all.push_back({score(k, i), k, i});
      }
    }
    std::ranges::stable_sort(all, std::greater{}, &Pair::score);
    return all;
  }

  void serve_needs() {
    std::set<std::size_t> moved;
    for (const Pair& pair : pairs()) {
      const auto& holders = held_by_[pair.target];
      const std::size_t seen = index_of(stations_[pair.station].sees);
      const bool helps = holders.empty() || (!is_served(pair.target, kNone, kNone) &&
                                             is_served(pair.target, pair.station, kNone));
      const bool may_go = seen == kNone || is_served(seen, kNone, pair.station);
      if (!helps || !may_go || moved.contains(pair.station)) continue;
      if (seen != kNone) std::erase(held_by_[seen], pair.station);
      give(pair.station, pair.target);
      moved.insert(pair.station);
    }
    std::erase_if(free_, [&](std::size_t k) { return moved.contains(k); });
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      by_count_.emplace(held_by_[i].size(), targets_[i].id, i);
    }
  }

  void serve_rest(std::size_t k) {
    if (by_count_.empty()) return;
    const std::size_t led_to = index_of(stations_[k].led_to);
    const std::size_t target = led_to != kNone ? led_to : std::get<2>(*by_count_.begin());
    by_count_.erase({held_by_[target].size(), targets_[target].id, target});
    give(k, target);
    by_count_.emplace(held_by_[target].size(), targets_[target].id, target);
  }

  std::span<const AllocatedTarget> targets_;
  std::span<const AllocatedStation> stations_;
  const LineSearchConfig& unit_;
  std::map<std::int64_t, std::size_t> index_;
  std::vector<std::vector<std::size_t>> held_by_;  // stations, by target
  std::vector<std::size_t> free_, spare_;          // stations
  std::set<std::tuple<std::size_t, std::int64_t, std::size_t>> by_count_;
  Allocation allocation_;
};

}  // namespace

Allocation allocate(std::span<const AllocatedTarget> targets,
                    std::span<const AllocatedStation> stations, const LineSearchConfig& unit) {
  return Allocator(targets, stations, unit).run();
}

}  // namespace ols::fusion
