#include "central/handover/station_allocation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "geometry/angles.h"
#include "geometry/wgs84.h"

namespace ols::fusion {
namespace {

constexpr double kKeep = 1.5;          // factor on the score of the present target
constexpr double kReact_s = 0.5;       // for every hand-over, besides the turn
constexpr double kGoodSine = 0.34;     // lines cross well from 20 degrees on,
constexpr double kOfBest = 0.5;        // or from this share of the best pair's sine
constexpr std::size_t kCompared = 64;  // free stations, and targets in need, that are compared

class Allocator {
 public:
  Allocator(std::span<const AllocatedTarget> targets, std::span<const AllocatedStation> stations,
            const LineSearchConfig& unit)
      : targets_(targets),
        stations_(stations),
        unit_(unit),
        held_by_(targets.size()),
        good_sine_(targets.size()) {
    for (std::size_t i = 0; i < targets.size(); ++i) index_[targets[i].id] = i;
    for (const AllocatedStation& station : stations) seen_by_.push_back(index_of(station.sees));
    allocation_.reserve(stations.size());
  }

  Allocation run(const std::optional<Eigen::Vector3d>& line_ecef) {
    for (std::size_t k = 0; k < stations_.size(); ++k) keep(k);
    serve_needs();
    if (line_ecef && !targets_.empty()) serve_line(*line_ecef);
    serve_rest();
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
  std::size_t seen_by(std::size_t station) const { return seen_by_[station]; }

  void give(std::size_t station, std::size_t target) {
    held_by_[target].push_back(station);
    if (stations_[station].is_led) allocation_[stations_[station].name] = targets_[target].id;
  }
  void take(std::size_t station) {
    if (const std::size_t seen = seen_by(station); seen != kNone) {
      std::erase(held_by_[seen], station);
    }
  }

  // Gives the station to the target that it sees. It stays movable if it is free, or if that target
  // may lend it.
  void keep(std::size_t k) {
    const AllocatedStation& station = stations_[k];
    const std::size_t seen = seen_by(k);
    if (station.is_busy) return;
    const bool is_lendable = !station.keeps_tracker && (seen == kNone || station.by_detector ||
                                                        !targets_[seen].keeps_trackers);
    if (seen != kNone) give(k, seen);
    if (station.is_led && is_lendable) movable_.push_back(k);
  }

  Eigen::Vector3d line(std::size_t station, std::size_t target) const {
    return (targets_[target].p_ecef - stations_[station].camera_ecef).normalized();
  }

  double sine(std::size_t one, std::size_t other, std::size_t target) const {
    return line(one, target).cross(line(other, target)).norm();
  }

  // All lines to a distant target may cross at small angles. Then the best pair of the site is the
  // measure.
  double good_sine(std::size_t target) const {
    std::optional<double>& known = good_sine_[target];
    if (known) return *known;
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < stations_.size() && all.size() < kCompared; ++k) {
      const bool may_see = stations_[k].is_led || seen_by(k) == target;
      if (may_see && !stations_[k].camera_ecef.isZero()) all.push_back(k);
    }
    double best = 0.0;
    for (std::size_t i = 0; i < all.size() && best < kGoodSine; ++i) {
      for (std::size_t j = 0; j < i; ++j) best = std::max(best, sine(all[i], all[j], target));
    }
    known = std::min(kGoodSine, kOfBest * best);
    return *known;
  }

  // Whether the lines of two of these stations cross well at the target.
  bool cross_well(std::span<const std::size_t> stations, std::size_t target) const {
    const auto all = stations.first(std::min(stations.size(), kCompared));
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (sine(all[i], all[j], target) >= good_sine(target)) return true;
      }
    }
    return false;
  }

  // Whether the stations at the target, or on their way to it, locate it well. `with`: an
  // additional one.
  bool is_served(std::size_t target, std::size_t with = kNone) const {
    std::vector<std::size_t> all = held_by_[target];
    if (with != kNone) all.push_back(with);
    return cross_well(all, target);
  }

  // Whether the target that the station sees can spare it: other stations that already see that
  // target are enough, or the station is needed for a target that is worth more.
  bool may_go(std::size_t station, double priority = 0.0) const {
    const std::size_t seen = seen_by(station);
    if (seen == kNone || priority > kKeep * targets_[seen].priority) return true;
    std::vector<std::size_t> others;
    std::ranges::copy_if(held_by_[seen], std::back_inserter(others),
                         [&](std::size_t k) { return k != station && seen_by(k) == seen; });
    return cross_well(others, seen);
  }

  double time_to(std::size_t k, const Eigen::Vector3d& p_ecef) const {
    const AllocatedStation& station = stations_[k];
    const Eigen::Vector3d there =
        R_ecef_enu(station.camera_ecef).transpose() * (p_ecef - station.camera_ecef).normalized();
    const bool is_known = station.axis && !station.camera_ecef.isZero();
    const double turn_rad =
        is_known ? angle_between(there, enu_from_azimuth_elevation(*station.axis)) : kPi / 4.0;
    return kReact_s + turning_s(turn_rad, unit_);
  }

  // A station on its way counts as arrived. Otherwise a station taken from a target would go back
  // at once, because its camera still looks there.
  double score(std::size_t k, std::size_t target) const {
    const auto& [id, p_ecef, priority, keeps_trackers] = targets_[target];
    if (id == stations_[k].led_to) return kKeep * priority / (kReact_s + turning_s(0.0, unit_));
    return (id == stations_[k].sees ? kKeep : 1.0) * priority / time_to(k, p_ecef);
  }

  std::vector<Pair> pairs() const {
    std::vector<std::size_t> needy;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      if (!is_served(i)) needy.push_back(i);
    }
    std::ranges::stable_sort(needy, std::greater{},
                             [&](std::size_t i) { return targets_[i].priority; });
    needy.resize(std::min(needy.size(), kCompared));
    std::vector<std::size_t> movable = movable_;
    std::stable_partition(movable.begin(), movable.end(),
                          [&](std::size_t k) { return seen_by(k) == kNone; });
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

  // First from the stations that can be spared, then from those of targets that are worth less. A
  // target that loses a station is served again, after those that are worth more.
  void serve_needs() {
    std::set<std::size_t> moved;
    while (serve_once(false, moved)) {
    }
    while (serve_once(true, moved)) {
    }
    std::erase_if(movable_, [&](std::size_t k) { return moved.contains(k); });
  }

  bool serve_once(bool by_priority, std::set<std::size_t>& moved) {
    bool has_moved = false;
    for (const Pair& pair : pairs()) {
      const auto& holders = held_by_[pair.target];
      const bool helps =
          holders.empty() || (!is_served(pair.target) && is_served(pair.target, pair.station));
      const double priority = by_priority ? targets_[pair.target].priority : 0.0;
      if (!helps || !may_go(pair.station, priority) || !moved.insert(pair.station).second) continue;
      take(pair.station);
      give(pair.station, pair.target);
      has_moved = true;
    }
    return has_moved;
  }

  // One station is enough: with the station whose line it is, they are two. Preferred is one that
  // searches already, then one without a target, then the one that arrives soonest.
  void serve_line(const Eigen::Vector3d& line_ecef) {
    std::size_t best = kNone;
    const auto cost = [&](std::size_t k) {
      const AllocatedStation& station = stations_[k];
      return std::tuple(!station.searches, seen_by(k) != kNone, time_to(k, line_ecef));
    };
    for (std::size_t i = 0; i < std::min(movable_.size(), kCompared); ++i) {
      const std::size_t k = movable_[i];
      if (!stations_[k].may_search || !may_go(k)) continue;
      if (best == kNone || cost(k) < cost(best)) best = k;
    }
    if (best == kNone) return;
    take(best);
    std::erase(movable_, best);
    allocation_[stations_[best].name] = kOnLine;
  }

  void serve_rest() {
    for (std::size_t i = 0; i < targets_.size(); ++i) list(i);
    if (by_count_.empty()) return;
    for (const std::size_t k : movable_) {
      const std::size_t seen = seen_by(k), target = rest_for(k);
      if (target == seen) continue;
      if (seen != kNone) unlist(seen);
      unlist(target);
      take(k);
      give(k, target);
      list(target);
      if (seen != kNone) list(seen);
    }
  }

  std::size_t rest_for(std::size_t k) const {
    const std::size_t seen = seen_by(k), led_to = index_of(stations_[k].led_to);
    const std::size_t present = seen != kNone ? seen : led_to, best = most_worth();
    if (present == kNone) return best;
    const std::size_t others = held_by_[present].size() - (seen != kNone ? 1U : 0U);
    const bool gains = worth(best, held_by_[best].size()) > kKeep * worth(present, others);
    return gains && may_go(k) ? best : present;
  }

  double worth(std::size_t target, std::size_t others) const {
    return targets_[target].priority / static_cast<double>(others + 1);
  }
  // Of targets with equally many stations, the one with the highest priority is best.
  std::size_t most_worth() const {
    std::size_t best = kNone;
    for (const auto& [count, targets] : by_count_) {
      const std::size_t i = std::get<2>(*targets.begin());
      if (best == kNone || worth(i, count) > worth(best, held_by_[best].size())) best = i;
    }
    return best;
  }
  using Entry = std::tuple<double, std::int64_t, std::size_t>;
  Entry entry(std::size_t target) const {
    return {-targets_[target].priority, targets_[target].id, target};
  }
  void list(std::size_t target) { by_count_[held_by_[target].size()].insert(entry(target)); }
  void unlist(std::size_t target) {
    const auto of_count = by_count_.find(held_by_[target].size());
    of_count->second.erase(entry(target));
    if (of_count->second.empty()) by_count_.erase(of_count);
  }

  std::span<const AllocatedTarget> targets_;
  std::span<const AllocatedStation> stations_;
  const LineSearchConfig& unit_;
  std::unordered_map<std::int64_t, std::size_t> index_;
  std::vector<std::size_t> seen_by_;                      // the target of each station, or kNone
  std::vector<std::vector<std::size_t>> held_by_;         // stations, by target
  mutable std::vector<std::optional<double>> good_sine_;  // by target; computed when needed
  std::vector<std::size_t> movable_;  // stations without a target, and those that may be lent
  std::map<std::size_t, std::set<Entry>> by_count_;  // targets, by the number of their stations
  Allocation allocation_;
};

}  // namespace

Allocation allocate(std::span<const AllocatedTarget> targets,
                    std::span<const AllocatedStation> stations, const LineSearchConfig& unit,
                    const std::optional<Eigen::Vector3d>& line_ecef) {
  return Allocator(targets, stations, unit).run(line_ecef);
}

}  // namespace ols::fusion
