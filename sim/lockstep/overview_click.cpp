#include "sim/lockstep/overview_click.h"

#include <algorithm>
#include <stdexcept>

#include "sim/lockstep/lockstep.h"

namespace ols::sim {
namespace {

constexpr double kStep_s = 0.02;

std::string overview_of(const Scenario& scenario) {
  const auto found = std::ranges::find(scenario.stations, true, &StationScenario::overview);
  if (found == scenario.stations.end()) throw std::runtime_error("no overview station");
  return found->id;
}

// As a person does: roughly there, and zoomed in a little.
void aim(const World& world, Lockstep& lockstep, const std::string& id, const ClickConfig& config) {
  const auto truth = std::ranges::find(world.stations(), id, &StationTruth::id);
  const double now_s = monotonic_s(config.aimed_s);
  const auto angles = aim_at(truth->nominal, world.target(0, config.clicked_s).p_ecef);
  station::Station& station = lockstep.station(id).station();
  station::LensCommand lens;
  lens.values.zoom = config.zoom;
  if (!angles || station.point({*angles}, now_s) != station::Refusal::kNone ||
      station.lens(lens, now_s) != station::Refusal::kNone) {
    throw std::runtime_error(id + " cannot be aimed");
  }
}

// A person's click is a few pixels off.
void click(Lockstep& lockstep, const std::string& id, double time_s) {
  LockstepStation& eye = lockstep.station(id);
  const Eigen::Vector2d at = eye.view().centre_px + Eigen::Vector2d(3.0, -2.0);
  const auto refusal =
      eye.station().designate({std::nullopt, {at.x(), at.y(), 0.0, 0.0}}, monotonic_s(time_s));
  if (eye.view().visible && refusal == station::Refusal::kNone) return;
  throw std::runtime_error(id + " does not take the click: " + to_string(refusal));
}

}  // namespace

LeadTimes click_in_overview(const Scenario& scenario, std::uint64_t seed,
                            const ClickConfig& config) {
  const World world(later(scenario, config.elapsed_s), seed);
  const std::string eye = overview_of(scenario);
  Lockstep lockstep(world, nobody_designates(scenario));
  lockstep.run(config.aimed_s);
  aim(world, lockstep, eye, config);
  lockstep.run(config.clicked_s);
  click(lockstep, eye, config.clicked_s);
  LeadTimes times;
  times.stations = scenario.stations.size() - 1;
  for (double after_s = kStep_s; after_s <= config.patience_s && !times.complete();
       after_s += kStep_s) {
    lockstep.run(config.clicked_s + after_s);
    for (const StationScenario& station : scenario.stations) {
      if (!station.overview) note(times, lockstep, station.id, after_s);
    }
    note_position(times, lockstep, after_s);
  }
  return times;
}

}  // namespace ols::sim
