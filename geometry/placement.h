// Chooses where to put stations: the best n of given places for an area to protect. Pure, and
// deterministic for a given generator.
//
// The value of a place is its information about each point of the area that it sees
// (geometry/precision.h). The best choice leaves the fewest points undetermined; among equals, the
// one with the least cost wins. The cost is the 3-D position error over the determined points: the
// root of its mean square, or its maximum. The search starts from random choices. It improves each
// choice by exchanging one place at a time for the best other place, until no exchange helps (V.
// Fedorov's exchange algorithm). If the worst point counts, it first minimises a power mean of high
// order: where several points share the largest error, no single exchange lowers the maximum.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "geometry/precision.h"

namespace ols {

// By default the worst point counts. If stations may stand anywhere around the area, kWorst gives
// the paper's regular polygon on the edge. kMean gives the polygon only for four or more stations;
// three stations it puts on one side of the area, at the expense of the far side.
enum class PlacementGoal { kMean, kWorst };

struct PlacementProblem {
  std::vector<PlannedStation> kept;    // stations already in place
  std::vector<PlannedStation> places;  // candidates, each used at most once
  std::vector<PlannedTarget> area;     // points of the area, with equal weights
  std::size_t stations = 0;            // number to choose
  PlacementGoal goal = PlacementGoal::kWorst;
  double exposures = 1.0;
  // A point with a larger error [m] counts as undetermined.
  double within_m = std::numeric_limits<double>::infinity();
  int starts = 30;
};

struct Placement {
  std::vector<std::size_t> chosen;  // indices into `places`, ascending
  // Number of points that the stations do not determine to within_m. Points at the place of a
  // station are not counted.
  std::size_t undetermined = 0;
  double mean_m = 0.0;   // root of the mean squared 3-D error over the other points
  double worst_m = 0.0;  // the largest root mean squared 3-D error of these points

  bool determines_all() const { return undetermined == 0; }
};

// Called repeatedly during a search, with the number of starts completed and the total.
using TellStarts = std::function<void(std::size_t done, std::size_t all)>;

// Throws std::invalid_argument if there are fewer places than stations, no area, or no station to
// choose.
Placement place_stations(const PlacementProblem& problem, std::mt19937_64& generator,
                         const TellStarts& tell = {});

// The cost of a given choice, for comparison.
Placement rate_placement(const PlacementProblem& problem, std::vector<std::size_t> chosen);

}  // namespace ols
