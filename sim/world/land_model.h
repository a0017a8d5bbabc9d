// What the product may know of the simulated land: a model of it, coarser than the truth and with
// errors, without trees and without houses that nobody has mapped. Pure.
#pragma once

#include <cstdint>
#include <memory>

#include "geometry/wgs84.h"
#include "land/terrain.h"
#include "sim/world/relief.h"

namespace ols::sim {

struct LandModel {
  land::HeightGrid grid;  // its heights are those below
  std::shared_ptr<const std::vector<float>> heights_m;
  std::vector<land::Covering> houses;

  std::shared_ptr<const land::Terrain> terrain() const {
    return std::make_shared<land::Terrain>(std::vector{grid}, houses, heights_m);
  }
};

// The errors are drawn from the seed.
LandModel survey(const ReliefScenario& scenario, const LocalFrame& site, std::uint64_t seed);

}  // namespace ols::sim
