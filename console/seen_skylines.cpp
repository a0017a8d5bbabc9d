#include "console/seen_skylines.h"

#include "console/rounded.h"
#include "geometry/angles.h"
#include "land/seen_skyline.h"

namespace ols::console {

void SeenSkylines::receive(const ReceivedSkyline& heard) {
  Known& known = known_[heard.station];
  if (known.begun_us != heard.begun_us) known = {heard.begun_us, {}};
  known.sectors[heard.sector] = heard.differing;
}

Json SeenSkylines::of(const std::string& station) const {
  Json differing = Json::array();
  if (const auto found = known_.find(station); found != known_.end()) {
    for (const auto& [sector, columns] : found->second.sectors) {
      for (const auto& [column, elevation_rad] : columns) {
        const double azimuth_rad = land::SeenSkyline::azimuth_rad(column);
        differing.push_back({rounded(degrees(azimuth_rad), 3), angle_deg(elevation_rad)});
      }
    }
  }
  return {{"differing", std::move(differing)}};
}

}  // namespace ols::console
