// The skyline as a station's pictures show it, in addition to that of the map. Pure.
//
// Angles are apparent, in the east-north-up frame at the camera, as in land/horizon_map.h.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "geometry/angles.h"
#include "land/horizon_map.h"

namespace ols::land {

// One azimuth: map and pictures, combined according to their errors.
struct SeenCrest {
  double elevation_rad = 0.0;
  double sd_rad = 0.0;  // 1-sigma
  // Everything at this horizontal distance or beyond is hidden. 0: the pictures do not change what
  // the map hides.
  double hides_from_m = 0.0;
  // Pictures and map differ by more than their errors. Then the elevation is that of the pictures.
  bool disagrees = false;

  bool operator==(const SeenCrest&) const = default;
};

class SeenSkyline {
 public:
  static constexpr int kColumns = 7200;  // of 0.05 degrees
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
  // In the order of their azimuths.
  std::vector<Column> sector(int sector) const;
  bool empty() const { return count_ == 0; }
  int count() const { return count_; }

  // The nearest column that has been seen, within 0.1 degrees. nullopt if there is none.
  std::optional<SeenCrest> at(double azimuth_rad) const;
  // The elevation below which a point at `distance_m` is hidden. `model`: that of the map up to
  // this distance. If only a column beside the azimuth has been seen, it can only raise this
  // elevation, because the edge of a house may stand between that column and the azimuth.
  Skyline hiding(const Skyline& model, double azimuth_rad, double distance_m) const;

 private:
  int count_ = 0;
  // Empty, or one for each column.
  std::vector<std::optional<SeenCrest>> crests_;
};

}  // namespace ols::land
