// Two walls north of the cameras, painted at random, before a bright sky.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

#include "geometry/angles.h"
#include "geometry/direction.h"
#include "geometry/wgs84.h"
#include "land/refraction.h"

namespace ols::scenery {

// The origin of east, north, up. All cameras stand on a line to the east through it.
inline const Geodetic kMiddle{radians(38.5), radians(-28.5), 100.0};

// A wall across the view to the north, painted at random.
struct Wall {
  double north_m, west_m, east_m, top_m, spot_m;

  double gray(double east, double up, std::uint32_t paint) const {
    const double u = east / spot_m, v = up / spot_m;
    const double a = u - std::floor(u), b = v - std::floor(v);
    const auto spot = [&](int i, int j) {
      const auto x = static_cast<std::uint32_t>(std::floor(u) + i + 5000);
      const auto y = static_cast<std::uint32_t>(std::floor(v) + j + 5000);
      std::uint32_t mixed = (x * 0x8da6b343U) ^ (y * 0xd8163841U) ^ (paint * 0xcb1ab31fU);
      mixed = (mixed ^ (mixed >> 13)) * 0x5bd1e995U;
      return 60.0 + (mixed >> 8) % 120;
    };
    return (1 - b) * ((1 - a) * spot(0, 0) + a * spot(1, 0)) +
           b * ((1 - a) * spot(0, 1) + a * spot(1, 1));
  }
};
inline constexpr std::array kWalls{Wall{1000.0, -50.0, 50.0, 25.0, 1.3},
                                   Wall{2000.0, -400.0, 400.0, 80.0, 2.6}};

inline constexpr double kSkyGray = 220.0;

// What a camera sees, `east_m` east of the origin. The walls of another `paint` look different.
inline std::uint8_t painted_gray(double east_m, const AzimuthElevation& apparent,
                                 std::uint32_t paint) {
  for (const Wall& wall : kWalls) {
    AzimuthElevation direction = apparent;
    direction.elevation_rad -= land::refraction_slope(land::kRefraction, wall.north_m);
    const Eigen::Vector3d ray = enu_from_azimuth_elevation(direction);
    if (ray.y() <= 0.0) continue;
    const double range_m = wall.north_m / ray.y();
    const double east = east_m + range_m * ray.x(), up = range_m * ray.z();
    if (east < wall.west_m || east > wall.east_m || up > wall.top_m) continue;
    // Each wall has its own painting.
    const std::uint32_t own = 2 * paint + (wall.north_m > 1500.0 ? 1 : 0);
    return static_cast<std::uint8_t>(wall.gray(east, up, own));
  }
  return static_cast<std::uint8_t>(kSkyGray);
}

}  // namespace ols::scenery
