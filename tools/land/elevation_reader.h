// Reads elevation models with GDAL, as heights on a lattice of latitude and longitude.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace ols::land {

// Max number of heights within a site's radius (2 GB).
inline constexpr double kMostHeights = 5e8;

struct Bounds {
  double south_deg = 0.0, north_deg = 0.0, west_deg = 0.0, east_deg = 0.0;
};
Bounds bounds_around(double latitude_deg, double longitude_deg, double radius_km);
// The whole turns (a multiple of 360) to add to a longitude, so that it is nearest to the middle of
// the bounds. The bounds of a site near longitude 180 reach beyond 180.
double turns_deg(const Bounds& bounds, double longitude_deg);

// The heights of one file within the bounds, counted from the file's own zero; NaN: not known.
struct Raster {
  std::string name;
  double north_deg = 0.0, west_deg = 0.0;  // position of the first height
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

// Throws std::runtime_error naming the file if it cannot be read, is damaged, is not georeferenced,
// has an unknown unit of height, or has more than kMostHeights within the bounds. A model that is
// not on a lattice of latitude and longitude is resampled to one with its own resolution.
ReadElevation read_elevation(const std::string& path, const Bounds& bounds);

}  // namespace ols::land
