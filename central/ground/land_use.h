// What the fusion knows of the land.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "land/surface.h"

namespace ols::fusion {

struct LandUse {
  std::shared_ptr<const land::Surface> surface{};  // null: no land is known
  // Stations whose designated objects stand on the ground, as the site has declared. No line of
  // sight shows that by itself: a drone before a hillside looks the same.
  std::vector<std::string> on_ground{};

  bool stands(const std::string& station) const {
    return surface && std::ranges::find(on_ground, station) != on_ground.end();
  }
};

}  // namespace ols::fusion
