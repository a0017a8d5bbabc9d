#include "sim/world/land_model.h"

#include <cmath>
#include <random>

#include "sim/scenario/seeds.h"

namespace ols::sim {
namespace {

constexpr std::uint64_t kHeightsTag = 15000, kHousesTag = 15001;

Geodetic below(const LocalFrame& site, const Eigen::Vector2d& place_m) {
  return geodetic_from_ecef(site.to_ecef({place_m.x(), place_m.y(), 0.0}));
}

land::Covering mapped(House house, const LandModelScenario& model, const LocalFrame& site,
                      std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  for (double& axis : house.centre_m) axis += model.outline_sd_m * normal(generator);
  land::Covering covering;
  covering.kind = land::CoveringKind::kBuilding;
  covering.height_m = house.size_m.z() + model.house_sd_m * normal(generator);
  covering.sd_m = model.house_sd_m;
  auto& ring = covering.rings.emplace_back();
  for (int i = 0; i < 4; ++i) {
    const Geodetic corner = below(site, house.corner_m(i));
    ring.emplace_back(corner.longitude_rad, corner.latitude_rad);
  }
  return covering;
}

}  // namespace

LandModel survey(const ReliefScenario& scenario, const LocalFrame& site, std::uint64_t seed) {
  const LandModelScenario& model = scenario.model;
  const Relief relief(scenario);
  const Waves errors(model.sd_m, model.length_m, derived_seed(seed, kHeightsTag));
  LandModel result;
  land::HeightGrid& grid = result.grid;
  const Geodetic north_west = below(site, {-model.reach_m, model.reach_m});
  const Geodetic south_east = below(site, {model.reach_m, -model.reach_m});
  grid.rows = grid.columns = static_cast<int>(2.0 * model.reach_m / model.spacing_m) + 1;
  grid.north_rad = north_west.latitude_rad;
  grid.west_rad = north_west.longitude_rad;
  grid.step_latitude_rad = (grid.north_rad - south_east.latitude_rad) / (grid.rows - 1);
  grid.step_longitude_rad = (south_east.longitude_rad - grid.west_rad) / (grid.columns - 1);
  grid.sd_m = model.sd_m;
  auto heights_m = std::make_shared<std::vector<float>>();
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const Geodetic place{grid.north_rad - row * grid.step_latitude_rad,
                           grid.west_rad + column * grid.step_longitude_rad,
                           site.origin().height_m};
      const Eigen::Vector2d at_m = site.to_enu(ecef_from_geodetic(place)).head<2>();
      heights_m->push_back(
          static_cast<float>(site.origin().height_m + relief.ground_m(at_m) + errors.at(at_m)));
    }
  }
  grid.heights_m = *heights_m;
  result.heights_m = heights_m;
  std::mt19937_64 generator(derived_seed(seed, kHousesTag));
  for (const House& house : scenario.houses) {
    if (house.mapped) result.houses.push_back(mapped(house, model, site, generator));
  }
  return result;
}

}  // namespace ols::sim
