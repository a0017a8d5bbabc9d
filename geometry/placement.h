// Where to put stations: the best n of given places for an area to protect. Pure and deterministic
// for a given generator.
//
// A place is worth its information about each point of the area (geometry/precision.h); the cost of
// a choice is the root of the mean, over the area, of the expected squared distance from the truth,
// or the greatest over the area (as a power mean of high order, which a search can descend). It
// starts from random choices and improves each by exchanging one place at a time for the best other
// one until none helps (V. Fedorov's exchange algorithm).
#pragma once

#include <cstddef>
#include <functional>
#include <random>
#include <span>
#include <vector>

#include "geometry/precision.h"

namespace ols {

// A point's error counts as so much where the stations do not determine it. Where one of them
// stands it does not count then.
inline constexpr double kUndetermined_m = 1e6;

// To protect an area means to protect its worst point: where the stations may stand anywhere around
// it, that gives the paper's regular polygon on its edge. The mean gives it too from four stations
// on; three it rather puts on one side, which the far side of the area pays for.
enum class PlacementGoal { kMean, kWorst };

struct PlacementProblem {
  std::vector<PlannedStation> kept;    // stand already
  std::vector<PlannedStation> places;  // can be used, each once
  std::vector<PlannedTarget> area;     // points that stand for it, each for as much of it
  std::size_t stations = 0;            // to choose
  PlacementGoal goal = PlacementGoal::kWorst;
  double exposures = 1.0;
  int starts = 30;
};

struct Placement {
  std::vector<std::size_t> chosen;  // of the places, in growing order
  double mean_m = 0.0;              // root of the mean squared 3-D error over the area
  double worst_m = 0.0;             // the greatest root mean squared 3-D error in it

  bool determines_all() const { return worst_m < 0.1 * kUndetermined_m; }
};

// Called again and again during a search: how many of the starts are done, and all of them.
using TellStarts = std::function<void(std::size_t done, std::size_t all)>;

// std::invalid_argument when there are fewer places than stations, no area or no station.
Placement place_stations(const PlacementProblem& problem, std::mt19937_64& generator,
                         const TellStarts& tell = {});

// The cost of a given choice, for comparison.
Placement rate_placement(const PlacementProblem& problem, std::vector<std::size_t> chosen);

}  // namespace ols
