// The fusion's knowledge of the land.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "land/surface.h"

namespace ols::fusion {

struct LandUse {
  std::shared_ptr<const land::Surface> surface{};  // null if no land is known
  // Stations whose designated objects stand on the ground, according to the site's configuration. A
  // line of sight does not show whether its object stands on the ground: a drone in front of a
  // hillside has the same line of sight.
  std::vector<std::string> on_ground{};

  bool follows_on_ground(const std::string& station) const {
    return surface && std::ranges::find(on_ground, station) != on_ground.end();
  }
};

}  // namespace ols::fusion
