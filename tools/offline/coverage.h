// Computes where over a site's land its stations can see targets, on a lattice of latitude and
// longitude.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/precision.h"
#include "land/horizon_map.h"
#include "tools/offline/planned_land.h"

namespace ols::offline {

struct Lattice {
  double north_rad = 0.0, west_rad = 0.0;  // centre of the first cell
  // Southward and eastward, both positive.
  double step_latitude_rad = 0.0, step_longitude_rad = 0.0;
  std::size_t rows = 0, columns = 0;

  std::size_t size() const { return rows * columns; }
  // Cells are numbered row by row from the north; the height is 0.
  Geodetic centre(std::size_t cell) const;
};

// A lattice that reaches `reach_m` in each direction from `middle`, with cells of `spacing_m` in
// both directions. Throws std::invalid_argument if it would have more than a million cells.
Lattice lattice_around(const Geodetic& middle, double reach_m, double spacing_m);

struct CoverageCell {
  std::optional<double> ground_m;  // ellipsoidal height; nullopt: the land is not known
  // The lowest height above the ground [m] that at least one station sees, and the lowest that at
  // least two see.
  std::optional<double> one_m, two_m;
  // 1-sigma of the 3-D position at each height, from the stations that see it.
  std::vector<std::optional<double>> errors_m;
};

struct Coverage {
  Lattice lattice;
  std::vector<double> heights_m;  // above the ground, ascending
  std::vector<CoverageCell> cells;
};

// A station, and the map of what the land hides from it.
struct LandView {
  PlannedStation station;
  std::shared_ptr<const land::HorizonMap> map;
};

using TellCells = std::function<void(std::size_t done, std::size_t all)>;

// `make_target`: returns the target at a place, as planned_target() does.
Coverage cover(const Lattice& lattice, const std::vector<double>& heights_m,
               const std::vector<LandView>& views, const PlannedLand& land,
               const std::function<PlannedTarget(const Geodetic&)>& make_target, double exposures,
               const TellCells& tell);

}  // namespace ols::offline
