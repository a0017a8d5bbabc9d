#include "tools/offline/coverage.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "land/lowest_visible.h"

namespace ols::offline {
namespace {

using Lowest = std::vector<std::optional<double>>;  // of each view, above the ground [m]

Lowest lowest_of(const Geodetic& centre, double ground_m, const std::vector<LandView>& views) {
  Lowest lowest;
  for (const LandView& view : views) {
    const auto lowest_m =
        land::lowest_visible_m(*view.map, centre.latitude_rad, centre.longitude_rad);
    lowest.push_back(lowest_m ? std::optional(std::max(0.0, *lowest_m - ground_m)) : std::nullopt);
  }
  return lowest;
}

std::vector<PlannedStation> seeing(const std::vector<LandView>& views, const Lowest& lowest,
                                   double height_m) {
  std::vector<PlannedStation> stations;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (lowest[i] && *lowest[i] <= height_m) stations.push_back(views[i].station);
  }
  return stations;
}

}  // namespace

Geodetic Lattice::centre(std::size_t cell) const {
  return {north_rad - static_cast<double>(cell / columns) * step_latitude_rad,
          west_rad + static_cast<double>(cell % columns) * step_longitude_rad, 0.0};
}

Lattice lattice_around(const Geodetic& middle, double reach_m, double spacing_m) {
  constexpr double kMostCells = 1e6;
  const auto half = static_cast<std::size_t>(reach_m / spacing_m);
  const auto side = 2 * half + 1;
  if (static_cast<double>(side) * static_cast<double>(side) > kMostCells) {
    throw std::invalid_argument("more than a million cells: choose a wider spacing");
  }
  const LocalFrame frame({middle.latitude_rad, middle.longitude_rad, 0.0});
  const Geodetic north = geodetic_from_ecef(frame.to_ecef({0.0, spacing_m, 0.0}));
  const Geodetic east = geodetic_from_ecef(frame.to_ecef({spacing_m, 0.0, 0.0}));
  Lattice lattice;
  lattice.step_latitude_rad = north.latitude_rad - middle.latitude_rad;
  lattice.step_longitude_rad = wrap_pi(east.longitude_rad - middle.longitude_rad);
  lattice.rows = lattice.columns = side;
  const auto n = static_cast<double>(half);
  lattice.north_rad = middle.latitude_rad + n * lattice.step_latitude_rad;
  lattice.west_rad = middle.longitude_rad - n * lattice.step_longitude_rad;
  return lattice;
}

Coverage cover(const Lattice& lattice, const std::vector<double>& heights_m,
               const std::vector<LandView>& views, const PlannedLand& land,
               const std::function<PlannedTarget(const Geodetic&)>& make_target, double exposures,
               const TellCells& tell) {
  Coverage coverage{lattice, heights_m, {}};
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    tell(i, lattice.size());
    Geodetic centre = lattice.centre(i);
    CoverageCell& cell = coverage.cells.emplace_back();
    cell.errors_m.resize(heights_m.size());
    cell.ground_m = land.ground_m(centre);
    if (!cell.ground_m) continue;
    const Lowest lowest = lowest_of(centre, *cell.ground_m, views);
    std::vector<double> seen_from_m;
    for (const auto& one : lowest) {
      if (one) seen_from_m.push_back(*one);
    }
    std::ranges::sort(seen_from_m);
    if (!seen_from_m.empty()) cell.one_m = seen_from_m[0];
    if (seen_from_m.size() > 1) cell.two_m = seen_from_m[1];
    for (std::size_t k = 0; k < heights_m.size(); ++k) {
      centre.height_m = *cell.ground_m + heights_m[k];
      const auto precision =
          position_precision(seeing(views, lowest, heights_m[k]), make_target(centre), exposures);
      if (precision) cell.errors_m[k] = std::sqrt(precision->covariance_ecef.trace());
    }
  }
  return coverage;
}

}  // namespace ols::offline
