#include "tools/offline/near_place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace ols::offline {

void require_near(const std::string& name, const Geodetic& place, const std::vector<Geodetic>& near,
                  const std::string& of, double farthest_m) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Geodetic& other : near) {
    nearest_m = std::min(nearest_m, (ecef_from_geodetic(place) - ecef_from_geodetic(other)).norm());
  }
  if (nearest_m <= farthest_m) return;
  std::ostringstream text;
  text << name << " is " << std::lround(1e-3 * nearest_m) << " km from " << of
       << ": are latitude and longitude exchanged?";
  throw std::invalid_argument(text.str());
}

}  // namespace ols::offline
