// Chooses where to put stations: from given places, the n that measure positions in an area best.
// Pure, and deterministic for a given generator.
//
// A place contributes information about each point of the area that it sees (geometry/precision.h).
// The best choice of places leaves the fewest points undetermined; among equals, the choice with
// the lowest cost wins. The cost is the 3-D position error over the determined points: its root
// mean square, or its maximum. The search starts from random choices. It improves each choice by
// exchanging one place at a time for the best other place, until no exchange helps (V. Fedorov's
// exchange algorithm). If the cost is the maximum, the search first minimises a power mean of high
// order instead: if several points share the largest error, no single exchange lowers the maximum.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "geometry/precision.h"

namespace ols {

// kMean: the cost is the root mean square; kWorst: the maximum. If stations may stand anywhere
// around the area, kWorst gives the paper's regular polygon on the edge. kMean gives this polygon
// only for four or more stations. With three stations, kMean puts all of them on one side of the
// area; the other side is then measured worse.
enum class PlacementGoal { kMean, kWorst };

struct PlacementProblem {
  std::vector<PlannedStation> kept;    // stations already in place
  std::vector<PlannedStation> places;  // candidates, each used at most once
  std::vector<PlannedTarget> area;     // points of the area, with equal weights
  std::size_t stations = 0;            // number to choose
  PlacementGoal goal = PlacementGoal::kWorst;
  double exposures = 1.0;  // number of independent exposures over which white errors average
  // A point with a larger error [m] counts as undetermined.
  double within_m = std::numeric_limits<double>::infinity();
  int starts = 30;  // number of random choices from which the search starts
};

struct Placement {
  std::vector<std::size_t> chosen;  // indices into `places`, ascending
  // The number of points that the stations do not determine to within_m. Points at the position of
  // a station are not counted.
  std::size_t undetermined = 0;
  double mean_m = 0.0;   // root mean square of the 3-D error over the other points
  double worst_m = 0.0;  // largest RMS 3-D error of one of these points

  bool determines_all() const { return undetermined == 0; }
};

// Called repeatedly during a search, with the number of completed starts and the total number.
using TellStarts = std::function<void(std::size_t done, std::size_t all)>;

// Throws std::invalid_argument if there are fewer places than stations, no area, or no station to
// choose.
Placement place_stations(const PlacementProblem& problem, std::mt19937_64& generator,
                         const TellStarts& tell = {});

// The cost of a given choice, for comparison.
Placement rate_placement(const PlacementProblem& problem, std::vector<std::size_t> chosen);

}  // namespace ols
