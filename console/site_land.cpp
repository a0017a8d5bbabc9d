#include "console/site_land.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "console/land_answers.h"
#include "console/rounded.h"
#include "geometry/angles.h"
#include "geometry/direction.h"
#include "land/horizon_map.h"
#include "land/refraction.h"

namespace ols::console {
namespace {

constexpr int kProfilePoints = 300;
constexpr double kFarthest_m = 60'000.0;  // of a profile

Json height_of(const std::optional<land::SurfaceHeight>& known) {
  return known ? rounded(known->height_m, 1) : Json(nullptr);
}

// From a camera to a point, by horizontal distance in the camera's frame.
struct Sight {
  LocalFrame frame;
  Eigen::Vector3d to_enu;
  double distance_m;
  AzimuthElevation apparent;  // as refraction lifts it

  Sight(const Geodetic& camera, const Geodetic& to)
      : frame(camera),
        to_enu(frame.to_enu(ecef_from_geodetic(to))),
        distance_m(to_enu.head<2>().norm()) {
    const double lift_m = land::refraction_slope(land::kRefraction, distance_m) * distance_m;
    apparent = azimuth_elevation_from_enu(to_enu + lift_m * Eigen::Vector3d::UnitZ());
  }

  // The ray is bent: between its ends it runs above the straight line.
  Geodetic at(double share) const {
    Geodetic place = geodetic_from_ecef(frame.to_ecef(share * to_enu));
    place.height_m +=
        land::refraction_slope(land::kRefraction, distance_m) * distance_m * share * (1.0 - share);
    return place;
  }
};

}  // namespace

WebResponse SiteLand::answer(const LandTask& task) {
  using What = LandTask::What;
  if (task.what == What::kAbout) return land_said(200, about().dump());
  if (!folder_.terrain) return no_land();
  return land_answer([&] {
    switch (task.what) {
      case What::kGround:
        return ground(task);
      case What::kHeights:
        return heights(task);
      default:
        return profile(task);
    }
  });
}

Json SiteLand::about() const {
  if (!folder_.terrain) return {{"version", nullptr}};
  const land::Manifest& manifest = folder_.manifest;
  return {{"version", folder_.version},
          {"latitude_deg", manifest.latitude_deg},
          {"longitude_deg", manifest.longitude_deg},
          {"radius_km", manifest.radius_km}};
}

Json SiteLand::ground(const LandTask& task) const {
  const double latitude_rad = radians(task.numbers[0]), longitude_rad = radians(task.numbers[1]);
  const auto ground = folder_.terrain->ground(latitude_rad, longitude_rad);
  return {{"ground_m", height_of(ground)},
          {"top_m", height_of(folder_.terrain->top(latitude_rad, longitude_rad))},
          {"sd_m", ground ? rounded(ground->sd_m, 1) : Json(nullptr)}};
}

Json SiteLand::heights(const LandTask& task) const {
  const auto& box = task.numbers;
  Json heights_m = Json::array();
  for (int row = 0; row < kHeightsAcross; ++row) {
    const double latitude_deg = box[3] + (box[1] - box[3]) * row / (kHeightsAcross - 1.0);
    for (int column = 0; column < kHeightsAcross; ++column) {
      const double longitude_deg = box[0] + (box[2] - box[0]) * column / (kHeightsAcross - 1.0);
      heights_m.push_back(
          height_of(folder_.terrain->ground(radians(latitude_deg), radians(longitude_deg))));
    }
  }
  return {{"columns", kHeightsAcross}, {"rows", kHeightsAcross}, {"heights_m", heights_m}};
}

Json SiteLand::profile(const LandTask& task) const {
  Geodetic to{radians(task.numbers[0]), radians(task.numbers[1]), 0.0};
  if (task.numbers.size() == 3) {
    to.height_m = task.numbers[2];
  } else {
    const auto top = folder_.terrain->top(to.latitude_rad, to.longitude_rad);
    if (!top) throw std::invalid_argument("the land does not know the ground there");
    to.height_m = top->height_m;
  }
  const Sight sight(task.camera, to);
  if (!(sight.distance_m >= 1.0) || sight.distance_m > kFarthest_m) {
    throw std::invalid_argument("a profile is 1 m to 60 km long");
  }
  Json points = Json::array();
  for (int i = 0; i <= kProfilePoints; ++i) {
    const double share = static_cast<double>(i) / kProfilePoints;
    const Geodetic at = sight.at(share);
    points.push_back({rounded(share * sight.distance_m, 1),
                      height_of(folder_.terrain->ground(at.latitude_rad, at.longitude_rad)),
                      height_of(folder_.terrain->top(at.latitude_rad, at.longitude_rad)),
                      rounded(at.height_m, 1)});
  }
  // With a map of this direction only, as the fusion and the skyline have it.
  constexpr double kSector_rad = radians(0.2);
  const land::HorizonMap map(*folder_.terrain, task.camera,
                             {.reach_m = sight.distance_m,
                              .from_azimuth_rad = sight.apparent.azimuth_rad - kSector_rad / 2.0,
                              .sector_rad = kSector_rad});
  const double cell_m =
      std::max(map.config().least_cell_m, 2.0 * kPi / map.config().columns * sight.distance_m);
  const auto hit = map.ground(sight.apparent);
  const double hit_m = hit ? hit->range_m * std::cos(sight.apparent.elevation_rad) : 0.0;
  const bool is_blocked = hit && hit_m < sight.distance_m - 2.0 * cell_m;
  const double known_m = map.known_to_m(sight.apparent.azimuth_rad);
  const bool is_known = known_m > sight.distance_m - 2.0 * cell_m;
  return {{"points", std::move(points)},
          {"blocked_m", is_blocked ? rounded(hit_m, 1) : Json(nullptr)},
          {"azimuth_deg", angle_deg(sight.apparent.azimuth_rad)},
          {"elevation_deg", angle_deg(sight.apparent.elevation_rad)},
          {"known_to_m", is_known ? Json(nullptr) : rounded(known_m, 0)}};
}

}  // namespace ols::console
