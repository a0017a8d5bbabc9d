// The product's model of the simulated land. It is coarser than the true land and has errors. It
// has no trees, and only those houses that are mapped. Pure.
#pragma once

#include <cstdint>
#include <memory>

#include "geometry/wgs84.h"
#include "land/terrain.h"
#include "sim/world/relief.h"

namespace ols::sim {

struct LandModel {
  land::HeightGrid grid;  // of heights_m
  std::shared_ptr<const std::vector<float>> heights_m;
  std::vector<land::Covering> houses;

  std::shared_ptr<const land::Terrain> terrain() const {
    return std::make_shared<land::Terrain>(std::vector{grid}, houses, heights_m);
  }
};

// Makes the model of a scenario's land. The seed determines its errors.
LandModel survey(const ReliefScenario& scenario, const LocalFrame& site, std::uint64_t seed);

}  // namespace ols::sim
