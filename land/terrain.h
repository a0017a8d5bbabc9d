// The surface of the land, from elevation models, buildings and woods.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "land/coverings.h"
#include "land/surface.h"

namespace ols::land {

// Heights at the nodes of a grid of latitude and longitude.
struct HeightGrid {
  double north_rad = 0.0, west_rad = 0.0;  // position of the first height
  // Both positive: rows go south, columns go east.
  double step_latitude_rad = 0.0, step_longitude_rad = 0.0;
  int rows = 0, columns = 0;  // at least 2 each
  double sd_m = 0.0;          // 1-sigma of a height
  // [m, above the WGS84 ellipsoid] Row by row from the north, each row from the west; NaN: unknown.
  std::span<const float> heights_m;
};

// Heights are interpolated bilinearly in a grid, if all four neighbouring heights are known. If
// several grids know a place, the first of them is used. A building's roof is level; tree-tops
// follow the ground; scenery has the height at which it was seen.
class Terrain : public Surface {
 public:
  // `memory` keeps the memory alive that the grids' `heights_m` refer to.
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
  std::vector<SurfaceHeight> bases_;  // for a building: the lowest ground at its corners
  CoveringIndex index_;
};

}  // namespace ols::land
