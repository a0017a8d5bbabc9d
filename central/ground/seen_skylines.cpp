#include "central/ground/seen_skylines.h"

#include <cmath>

#include "geometry/chi_square.h"
#include "geometry/direction.h"
#include "geometry/wgs84.h"
#include "land/refraction.h"

namespace ols::fusion {

bool SeenSkylines::take(const SkylineSector& sector) {
  Known& known = skylines_[sector.station];
  const bool is_new = known.begun_us != sector.begun_us;
  if (is_new) known = {};
  known.begun_us = sector.begun_us;
  known.camera_ecef = sector.camera_ecef;
  known.heading_disagrees = sector.heading_disagrees;
  known.crests.set_sector(sector.sector, sector.columns);
  return is_new;
}

const land::SeenSkyline* SeenSkylines::of(const std::string& station,
                                          const Eigen::Vector3d& camera_ecef) const {
  const auto found = skylines_.find(station);
  if (found == skylines_.end()) return nullptr;
  const Known& known = found->second;
  const bool is_there = (known.camera_ecef - camera_ecef).norm() <= kMoved_m;
  return is_there && !known.heading_disagrees && !known.crests.empty() ? &known.crests : nullptr;
}

double SeenSkylines::visibility(const std::string& station, const Eigen::Vector3d& camera_ecef,
                                const Eigen::Vector3d& target_ecef,
                                const Eigen::Matrix3d& covariance_ecef) const {
  const land::SeenSkyline* skyline = of(station, camera_ecef);
  if (skyline == nullptr) return 1.0;
  const LocalFrame frame(geodetic_from_ecef(camera_ecef));
  const Eigen::Vector3d enu = frame.to_enu(target_ecef);
  const double distance_m = enu.head<2>().norm();
  const auto crest = skyline->at(std::atan2(enu.x(), enu.y()));
  if (!crest || crest->hides_from_m == 0.0 || distance_m < crest->hides_from_m) return 1.0;
  const double lift = land::refraction_slope(land::kRefraction, distance_m);
  const double above_rad = std::atan(enu.z() / distance_m + lift) - crest->elevation_rad;
  const Eigen::Vector2d outward = enu.head<2>() / distance_m;
  const Eigen::Vector3d rise_enu =  // of the elevation, by metre
      Eigen::Vector3d(-enu.z() * outward.x(), -enu.z() * outward.y(), distance_m) /
      enu.squaredNorm();
  const Eigen::Vector3d rise = frame.R_ecef_enu() * rise_enu;
  const double sd_rad = std::sqrt(rise.dot(covariance_ecef * rise) + crest->sd_rad * crest->sd_rad);
  return normal_level(-above_rad / sd_rad);
}

}  // namespace ols::fusion
