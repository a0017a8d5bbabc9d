// The seen skyline: the skyline as a station's own pictures show it, in addition to the skyline of
// the horizon map. Pure.
//
// Elevations are apparent, in the east-north-up frame at the camera, as in land/horizon_map.h.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "geometry/angles.h"
#include "land/horizon_map.h"

namespace ols::land {

// The skyline at one azimuth, from map and pictures, combined according to their errors.
struct SeenCrest {
  double elevation_rad = 0.0;
  double sd_rad = 0.0;  // 1-sigma
  // Below elevation_rad, everything at this horizontal distance or beyond is hidden. 0: the
  // pictures do not change what the map hides.
  double hides_from_m = 0.0;
  // Whether pictures and map differ by more than their errors. If so, the elevation is that of the
  // pictures.
  bool disagrees = false;

  bool operator==(const SeenCrest&) const = default;
};

class SeenSkyline {
 public:
  static constexpr int kColumns = 7200;  // each 0.05 degrees wide
  static constexpr int kSectors = 72;    // each with the same number of columns
  static constexpr int kSectorColumns = kColumns / kSectors;

  struct Column {
    int column = 0;
    SeenCrest crest;
  };

  static int column_of(double azimuth_rad);
  static double azimuth_rad(int column) { return (column + 0.5) * 2.0 * kPi / kColumns; }

  void set(int column, const SeenCrest& crest);
  void remove(int column);
  // Replaces all columns of a sector; columns of other sectors are ignored.
  void set_sector(int sector, std::span<const Column> columns);
  // The columns of a sector that have been seen, in the order of their azimuths.
  std::vector<Column> sector(int sector) const;
  bool empty() const { return count_ == 0; }
  int count() const { return count_; }

  // The skyline in the nearest column that has been seen, if this column is within 0.1 degrees;
  // otherwise nullopt.
  std::optional<SeenCrest> at(double azimuth_rad) const;
  // The elevation below which a point at `distance_m` is hidden. `model`: the same elevation
  // according to the map, HorizonMap::highest_before(). If the azimuth's own column has not been
  // seen, a neighbouring column can raise this elevation but not lower it, because the edge of a
  // house may be between the two columns.
  Skyline hiding(const Skyline& model, double azimuth_rad, double distance_m) const;

 private:
  int count_ = 0;
  // Empty, or one element for each column.
  std::vector<std::optional<SeenCrest>> crests_;
};

}  // namespace ols::land
