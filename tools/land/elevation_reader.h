// Elevation models that GDAL reads, as heights on a lattice of latitude and longitude.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace ols::land {

// Within a site's radius; 2 GB.
inline constexpr double kMostHeights = 5e8;

struct Bounds {
  double south_deg = 0.0, north_deg = 0.0, west_deg = 0.0, east_deg = 0.0;
};
Bounds bounds_around(double latitude_deg, double longitude_deg, double radius_km);

// Heights of one file within bounds, as the file has them; NaN: not known.
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
  std::optional<Raster> raster;  // nothing if the file is elsewhere
  std::vector<std::string> notes;
};

// Throws std::runtime_error naming the file: it cannot be read, is damaged, states no place, has a
// unit of height that is not known, or more heights within the bounds than memory is meant for. A
// model that is not on a lattice of latitude and longitude is resampled to one of its own
// resolution.
ReadElevation read_elevation(const std::string& path, const Bounds& bounds);

}  // namespace ols::land
