#include "sim/lockstep/lead_times.h"

#include <memory>
#include <utility>

namespace ols::sim {
namespace {

struct Later final : Trajectory {
  Later(std::shared_ptr<const Trajectory> flight, double by)
      : flight_(std::move(flight)), by_s_(by) {}
  Motion at(double time_s) const override { return flight_->at(time_s + by_s_); }

 private:
  std::shared_ptr<const Trajectory> flight_;
  double by_s_;
};

}  // namespace

Scenario later(Scenario scenario, double by_s) {
  for (TargetScenario& target : scenario.targets) {
    target.trajectory = std::make_shared<Later>(target.trajectory, by_s);
  }
  return scenario;
}

Fidelity nobody_designates(const Scenario& scenario) {
  Fidelity fidelity;
  for (const StationScenario& station : scenario.stations) {
    fidelity.not_designated.push_back(station.id);
  }
  return fidelity;
}

void note(LeadTimes& times, Lockstep& lockstep, const std::string& id, double after_s) {
  const LockstepStation& station = lockstep.station(id);
  const auto snapshot = station.station().snapshot();
  const auto tried = snapshot.counters.find("acquisitions");
  if (tried != snapshot.counters.end()) {
    times.acquisitions[id] = static_cast<int>(tried->second);
    times.acquired.emplace(id, after_s);
  }
  if (!station.view().visible) return;
  times.in_picture.emplace(id, after_s);
  const auto box = station.station().target_box();
  const Eigen::Vector2d& centre = station.view().centre_px;
  const bool on_it = box && box->contains({centre.x(), centre.y()});
  if (snapshot.state == station::StationState::kTracking && on_it)
    times.follows.emplace(id, after_s);
}

void note_position(LeadTimes& times, const Lockstep& lockstep, double after_s) {
  const auto counters = lockstep.fusion().health().counters;
  const auto located = counters.find("tracks_confirmed");
  if (!times.located && located != counters.end() && located->second > 0.0) times.located = after_s;
}

}  // namespace ols::sim
