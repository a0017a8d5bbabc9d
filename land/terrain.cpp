#include "land/terrain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/angles.h"

namespace ols::land {
namespace {

constexpr double kRounding = 1e-7;  // of a step: a place on the edge of a grid is on it

// The cell before `at` and the share of the next one; nothing outside of 0..count-1.
std::optional<std::pair<int, double>> cell_of(double at, int count) {
  if (!(at >= -kRounding && at <= count - 1 + kRounding)) return std::nullopt;
  const int cell = std::clamp(static_cast<int>(at), 0, count - 2);
  return std::pair(cell, std::clamp(at - cell, 0.0, 1.0));
}

}  // namespace

std::optional<double> Terrain::Placed::height_m(double latitude_rad, double longitude_rad) const {
  const auto row = cell_of((grid.north_rad - latitude_rad) * rows_per_rad, grid.rows);
  if (!row) return std::nullopt;
  double east_rad = longitude_rad - grid.west_rad;
  if (east_rad < -kRounding * grid.step_longitude_rad) east_rad += 2.0 * kPi;  // beyond 180 degrees
  const auto column = cell_of(east_rad * columns_per_rad, grid.columns);
  if (!column) return std::nullopt;
  const float* at = grid.heights_m.data() + static_cast<std::ptrdiff_t>(row->first) * grid.columns +
                    column->first;
  const double north = at[0] + column->second * (at[1] - at[0]);
  const double south =
      at[grid.columns] + column->second * (at[grid.columns + 1] - at[grid.columns]);
  const double height = north + row->second * (south - north);
  if (std::isnan(height)) return std::nullopt;
  return height;
}

Terrain::Terrain(const std::vector<HeightGrid>& grids, std::vector<Covering> coverings,
                 std::shared_ptr<const void> memory)
    : memory_(std::move(memory)), coverings_(std::move(coverings)), index_(coverings_) {
  for (const HeightGrid& grid : grids) {
    grids_.push_back({grid, 1.0 / grid.step_latitude_rad, 1.0 / grid.step_longitude_rad});
  }
  for (const Covering& covering : coverings_) {
    SurfaceHeight base{std::numeric_limits<double>::infinity(), 0.0};
    for (const auto& ring : covering.rings) {
      for (const Eigen::Vector2d& corner : ring) {
        const auto at = ground(corner.y(), corner.x());
        if (at && at->height_m < base.height_m) base = *at;
      }
    }
    bases_.push_back(base);
  }
}

std::optional<SurfaceHeight> Terrain::ground(double latitude_rad, double longitude_rad) const {
  for (const Placed& placed : grids_) {
    if (const auto height_m = placed.height_m(latitude_rad, longitude_rad)) {
      return SurfaceHeight{*height_m, placed.grid.sd_m};
    }
  }
  return std::nullopt;
}

SurfaceHeight Terrain::top_of(std::size_t covering, const SurfaceHeight& ground) const {
  const Covering& one = coverings_[covering];
  if (one.kind == CoveringKind::kScenery) return {one.height_m, one.sd_m};
  const bool is_level =
      one.kind == CoveringKind::kBuilding && std::isfinite(bases_[covering].height_m);
  const SurfaceHeight& base = is_level ? bases_[covering] : ground;
  return {base.height_m + one.height_m, std::hypot(base.sd_m, one.sd_m)};
}

std::optional<SurfaceHeight> Terrain::top(double latitude_rad, double longitude_rad) const {
  const auto known = ground(latitude_rad, longitude_rad);
  if (!known) return known;
  SurfaceHeight highest = *known;
  index_.for_each_at({longitude_rad, latitude_rad}, [&](std::size_t covering) {
    const SurfaceHeight top = top_of(covering, *known);
    if (top.height_m > highest.height_m) highest = top;
  });
  return highest;
}

}  // namespace ols::land
