#include "geometry/placement.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace ols {
namespace {

using Eigen::Matrix3d;

// A camera does not see what is nearer, least of all its own place.
constexpr double kNearest_m = 1.0;

// The greatest error alone gives the search nothing to descend where several points share it: the
// power mean of this order stands for it.
constexpr double kOrder = 10.0;

struct Rated {
  Placement placement;
  double cost = 0.0;  // what the search makes least
};

// The information that every place gives about every point of the area.
class Search {
 public:
  explicit Search(const PlacementProblem& problem) : problem_(problem) {
    for (const PlannedTarget& target : problem.area) {
      Matrix3d kept = Matrix3d::Identity() / (kUndetermined_m * kUndetermined_m);
      for (const PlannedStation& station : problem.kept) kept += information(station, target);
      kept_.push_back(kept);
    }
    for (const PlannedStation& place : problem.places) {
      auto& row = places_.emplace_back();
      for (const PlannedTarget& target : problem.area) row.push_back(information(place, target));
    }
  }

  Rated rate(const std::vector<std::size_t>& chosen) const {
    double sum = 0.0, worst = 0.0, powers = 0.0;
    for (std::size_t point = 0; point < kept_.size(); ++point) {
      Matrix3d total = kept_[point];
      for (const std::size_t place : chosen) total += places_[place][point];
      const double squared = total.inverse().trace();
      sum += squared;
      worst = std::max(worst, squared);
      powers += std::pow(squared, kOrder);
    }
    const auto points = static_cast<double>(kept_.size());
    const double mean_m = std::sqrt(sum / points), worst_m = std::sqrt(worst);
    const bool for_mean = problem_.goal == PlacementGoal::kMean;
    return {{chosen, mean_m, worst_m}, for_mean ? mean_m : std::pow(powers / points, 0.5 / kOrder)};
  }

  // Exchanges one place at a time until none helps.
  Rated improve(const std::vector<std::size_t>& chosen) const {
    constexpr double kWorthIt = 1.0 - 1e-9;
    Rated best = rate(chosen);
    for (bool improved = true; improved;) {
      improved = false;
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        const Rated better = best_exchange(best, i);
        if (better.cost < kWorthIt * best.cost) {
          best = better;
          improved = true;
        }
      }
    }
    std::ranges::sort(best.placement.chosen);
    return best;
  }

 private:
  Matrix3d information(const PlannedStation& station, const PlannedTarget& target) const {
    if ((target.p_ecef - station.place.origin_ecef()).norm() < kNearest_m) return Matrix3d::Zero();
    return bearing_information(bearing_precision(station, target, problem_.exposures),
                               target.p_ecef);
  }

  Rated best_exchange(const Rated& from, std::size_t i) const {
    Rated best = from;
    std::vector<std::size_t> chosen = from.placement.chosen;
    for (std::size_t place = 0; place < places_.size(); ++place) {
      if (std::ranges::count(from.placement.chosen, place) > 0) continue;
      chosen[i] = place;
      const Rated other = rate(chosen);
      if (other.cost < best.cost) best = other;
    }
    return best;
  }

  const PlacementProblem& problem_;
  std::vector<Matrix3d> kept_;                 // by point
  std::vector<std::vector<Matrix3d>> places_;  // by place and point
};

void check(const PlacementProblem& problem) {
  if (problem.area.empty()) throw std::invalid_argument("the area has no point");
  if (problem.stations == 0) throw std::invalid_argument("there is no station to place");
  if (problem.places.size() < problem.stations) {
    throw std::invalid_argument("there are fewer places than stations");
  }
}

}  // namespace

Placement place_stations(const PlacementProblem& problem, std::mt19937_64& generator) {
  check(problem);
  const Search search(problem);
  std::vector<std::size_t> order(problem.places.size());
  std::iota(order.begin(), order.end(), 0);
  Rated best{{}, std::numeric_limits<double>::infinity()};
  for (int start = 0; start < problem.starts; ++start) {
    std::ranges::shuffle(order, generator);
    const auto count = static_cast<std::ptrdiff_t>(problem.stations);
    const Rated found = search.improve({order.begin(), order.begin() + count});
    if (found.cost < best.cost) best = found;
  }
  return best.placement;
}

Placement rate_placement(const PlacementProblem& problem, std::vector<std::size_t> chosen) {
  check(problem);
  for (const std::size_t place : chosen) {
    if (place >= problem.places.size()) throw std::invalid_argument("there is no such place");
  }
  return Search(problem).rate(chosen).placement;
}

}  // namespace ols
