// Computes what a site's stations see over its land, on a lattice of latitude and longitude.
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
  double north_rad = 0.0, west_rad = 0.0;                    // of the first cell's centre
  double step_latitude_rad = 0.0, step_longitude_rad = 0.0;  // both positive: south and east
  std::size_t rows = 0, columns = 0;

  std::size_t size() const { return rows * columns; }
  Geodetic centre(std::size_t cell) const;  // row by row from the north; at height 0
};

// Cells are `spacing_m` long in both directions, up to `reach_m` from a place. Throws
// std::invalid_argument for more than a million.
Lattice lattice_around(const Geodetic& middle, double reach_m, double spacing_m);

struct CoverageCell {
  std::optional<double> ground_m;  // ellipsoidal; nullopt where the land is not known
  // The lowest heights above the ground [m] that one station sees, and that two see.
  std::optional<double> one_m, two_m;
  std::vector<std::optional<double>> errors_m;  // 3-D, 1-sigma, at each height, from the stations
                                                // that see it
};

struct Coverage {
  Lattice lattice;
  std::vector<double> heights_m;  // above the ground, ascending
  std::vector<CoverageCell> cells;
};

// A station and what the land hides from it.
struct LandView {
  PlannedStation station;
  std::shared_ptr<const land::HorizonMap> map;
};

using TellCells = std::function<void(std::size_t done, std::size_t all)>;

// `make_target` gives the target at a place, as planned_target() does.
Coverage cover(const Lattice& lattice, const std::vector<double>& heights_m,
               const std::vector<LandView>& views, const PlannedLand& land,
               const std::function<PlannedTarget(const Geodetic&)>& make_target, double exposures,
               const TellCells& tell);

}  // namespace ols::offline
