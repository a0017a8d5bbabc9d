// The land of elevation models, buildings and woods.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "land/coverings.h"
#include "land/surface.h"

namespace ols::land {

// Heights at the crossings of a lattice of latitude and longitude.
struct HeightGrid {
  double north_rad = 0.0, west_rad = 0.0;                    // of the first height
  double step_latitude_rad = 0.0, step_longitude_rad = 0.0;  // both positive: south and east
  int rows = 0, columns = 0;                                 // at least 2 each
  double sd_m = 0.0;                                         // 1-sigma of a height
  // Row by row from the north, each from the west [m, above the WGS84 ellipsoid]; NaN: not known.
  std::span<const float> heights_m;
};

// Bilinear within a grid, where all four heights around are known. Where several grids know a
// place, the first does. A building's roof is level, tree-tops follow the ground.
class Terrain : public Surface {
 public:
  // `memory` lives as long as the grids' heights do.
  Terrain(const std::vector<HeightGrid>& grids, std::vector<Covering> coverings,
          std::shared_ptr<const void> memory);

  std::optional<SurfaceHeight> ground(double latitude_rad, double longitude_rad) const override;
  std::optional<SurfaceHeight> top(double latitude_rad, double longitude_rad) const override;

 private:
  struct Placed {
    HeightGrid grid;
    double rows_per_rad, columns_per_rad;

    std::optional<double> height_m(double latitude_rad, double longitude_rad) const;
  };
  SurfaceHeight top_of(std::size_t covering, const SurfaceHeight& ground) const;

  std::shared_ptr<const void> memory_;
  std::vector<Placed> grids_;
  std::vector<Covering> coverings_;
  std::vector<SurfaceHeight> bases_;  // of buildings: the lowest ground at their corners
  CoveringIndex index_;
};

}  // namespace ols::land
