#include "sim/lockstep/unattended.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/lockstep/lockstep.h"

namespace ols::sim {
namespace {

using fusion::ObjectClass;

constexpr double kOnLine_rad = radians(0.5), kNear_m = 3.0, kSigmas = 5.0;

ObjectClass class_of(FlyerShape shape) {
  switch (shape) {
    case FlyerShape::kBird:
      return ObjectClass::kBird;
    case FlyerShape::kAircraft:
      return ObjectClass::kAircraft;
    default:
      return ObjectClass::kDrone;
  }
}

class Observer {
 public:
  Observer(const World& world, UnattendedRun& run) : world_(world), run_(run) {}

  void hear(const fusion::FusedTarget& target, double time_s) {
    const double at_s = 1e-6 * static_cast<double>(target.utime_us - Lockstep::kStartUtime_us);
    const bool located = target.estimate.solution == fusion::Solution::kOk;
    if (!located && !target.bearing_only) return;
    const auto index =
        located ? nearest(target.estimate, at_s) : along(target.bearing_only->sight, at_s);
    const bool is_drone = target.appearance.object_class == ObjectClass::kDrone;
    if (!index) {
      if (located) run_.ghosts.insert(target.target_id);
      if (located && is_drone) ++run_.drones_that_are_none;
      return;
    }
    FoundTarget& found = run_.targets[world_.scenario().targets[*index].id];
    if (!found.seen_s) found.seen_s = time_s;
    if (!located) return;
    if (!found.located_s) found.located_s = time_s;
    found.identities.insert(target.target_id);
    judge_name(*index, target.appearance.object_class, time_s, found);
  }

 private:
  void judge_name(std::size_t index, ObjectClass named, double time_s, FoundTarget& found) {
    if (named == ObjectClass::kUnknown) return;
    const ObjectClass own = class_of(world_.scenario().targets[index].shape);
    if (named != own) ++found.wrong_names;
    if (named != own && named == ObjectClass::kDrone) ++run_.drones_that_are_none;
    if (named == own && !found.named_s) found.named_s = time_s;
  }

  std::optional<std::size_t> nearest(const fusion::Estimate& estimate, double at_s) const {
    const double limit_m = std::max(kNear_m, kSigmas * std::sqrt(estimate.covariance_ecef.trace()));
    return best(
        limit_m, [&](const Eigen::Vector3d& p) { return (p - estimate.position_ecef).norm(); },
        at_s);
  }
  std::optional<std::size_t> along(const LineOfSight& sight, double at_s) const {
    const Eigen::Vector3d direction = direction_ecef(sight);
    return best(
        kOnLine_rad,
        [&](const Eigen::Vector3d& p) { return angle_between(direction, p - sight.origin_ecef); },
        at_s);
  }
  template <class Off>
  std::optional<std::size_t> best(double limit, const Off& off, double at_s) const {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < world_.scenario().targets.size(); ++i) {
      const double by = off(world_.target(i, at_s).p_ecef);
      if (by < limit) limit = by, found = i;
    }
    return found;
  }

  const World& world_;
  UnattendedRun& run_;
};

}  // namespace

UnattendedRun run_unattended(const Scenario& scenario, std::uint64_t seed, double seconds,
                             const std::vector<ObjectClass>& classes) {
  const World world(scenario, seed);
  Fidelity fidelity = nobody_designates(scenario);
  fidelity.handover.mode = fusion::HandoverMode::kAutomatic;
  fidelity.handover.classes = classes;
  Lockstep lockstep(world, fidelity);
  UnattendedRun run;
  Observer observer(world, run);
  const auto note_all = [&](LeadTimes& times, double time_s) {
    for (const StationScenario& station : scenario.stations) {
      if (!station.overview) note(times, lockstep, station.id, time_s);
    }
  };
  run.first.stations = static_cast<std::size_t>(
      std::ranges::count(scenario.stations, false, &StationScenario::overview));
  lockstep.listen([&](const fusion::FusedTarget& target, double time_s) {
    observer.hear(target, time_s);
    note_all(run.first, time_s);
  });
  lockstep.run(seconds);
  LeadTimes at_the_end;
  note_all(at_the_end, seconds);
  run.stations_on_it = at_the_end.follows.size();
  return run;
}

}  // namespace ols::sim
