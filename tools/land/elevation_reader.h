// Elevation models that GDAL reads, as heights on a lattice of latitude and longitude.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace ols::land {

// Limit for the heights within a site's radius: 2 GB.
inline constexpr double kMostHeights = 5e8;

struct Bounds {
  double south_deg = 0.0, north_deg = 0.0, west_deg = 0.0, east_deg = 0.0;
};
Bounds bounds_around(double latitude_deg, double longitude_deg, double radius_km);
// What to add to a longitude for it to be the one nearest to the middle of the bounds: whole turns.
// Bounds of a site near 180 degrees reach beyond it.
double turns_deg(const Bounds& bounds, double longitude_deg);

// The heights of one file within the bounds, as the file has them; NaN: not known.
struct Raster {
  std::string name;
  double north_deg = 0.0, west_deg = 0.0;  // of the first height
  double step_latitude_deg = 0.0, step_longitude_deg = 0.0;
  int rows = 0, columns = 0;
  std::vector<float> heights_m;

  double latitude_deg(int row) const { return north_deg - row * step_latitude_deg; }
  double longitude_deg(int column) const { return west_deg + column * step_longitude_deg; }
};

struct ReadElevation {
  std::optional<Raster> raster;  // nullopt if the file lies outside of the bounds
  std::vector<std::string> notes;
};

// Throws std::runtime_error naming the file: it cannot be read, is damaged, states no place, has an
// unknown unit of height, or has more than kMostHeights within the bounds. A model that is not on a
// lattice of latitude and longitude is resampled to one with its own resolution.
ReadElevation read_elevation(const std::string& path, const Bounds& bounds);

}  // namespace ols::land
