// An area that an operator has drawn: a volume, the object classes to watch for, and the times of
// day at which the area is watched. Pure.
#pragma once

#include <Eigen/Core>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "geometry/wgs84.h"

namespace ols::console {

struct Area {
  std::string name;  // unique at the site
  // Longitude, latitude [deg, WGS84] of each corner, clockwise or counterclockwise. The first
  // corner is not repeated at the end. Edges are straight in longitude and latitude, as in GeoJSON.
  // They may cross the antimeridian.
  std::vector<std::array<double, 2>> corners_deg;
  double lowest_m = 0.0, highest_m = 0.0;  // above the WGS84 ellipsoid
  std::vector<std::string> classes;        // names of wire::kObjectClasses; empty: all
  // The area is watched between these minutes of the day, in the time zone of the console's host.
  // If both are equal, the area is always watched. If the end is before the beginning, the end is
  // on the next day.
  int from_min = 0, to_min = 0;
};

// Reads an area from outside: {"name", "polygon", "lowest_m", "highest_m", "classes", "from",
// "to"}. Throws std::invalid_argument; the message says what is wrong.
Area area_from(const nlohmann::json& json);
nlohmann::json json_of(const Area& area);

bool is_watched(const Area& area, int minute_of_day);
bool concerns(const Area& area, const std::string& object_class);

// The probability that a target is in the area, from the target's position and its covariance [m^2]
// in east, north, up at the target. Exact for a Gaussian horizontal error; the correlation between
// height and horizontal position is ignored. nullopt: a number is not finite, or the matrix is not
// a valid covariance.
std::optional<double> probability_inside(const Area& area, const Geodetic& position,
                                         const Eigen::Matrix3d& covariance_enu_m2);

}  // namespace ols::console
