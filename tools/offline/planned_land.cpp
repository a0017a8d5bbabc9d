#include "tools/offline/planned_land.h"

#include <stdexcept>
#include <utility>

namespace ols::offline {

PlannedLand::PlannedLand(const std::string& folder) : folder_(land::read_terrain_folder(folder)) {}

std::optional<double> PlannedLand::ground_m(const Geodetic& place) const {
  const auto ground = surface().ground(place.latitude_rad, place.longitude_rad);
  return ground ? std::optional(ground->height_m) : std::nullopt;
}

std::shared_ptr<const land::HorizonMap> PlannedLand::look(const std::string& station,
                                                          const Geodetic& camera,
                                                          double reach_m) const {
  try {
    return std::make_shared<land::HorizonMap>(
        surface(), camera, land::HorizonMapConfig{.columns = kPlanColumns, .reach_m = reach_m});
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(station + ": " + error.what());
  }
}

void hide_behind(std::shared_ptr<const land::HorizonMap> map, PlannedStation& station) {
  station.sees = [map = std::move(map)](const Eigen::Vector3d& p_ecef) {
    return map->visible_probability(p_ecef, Eigen::Matrix3d::Zero()) > 0.5;
  };
}

}  // namespace ols::offline
