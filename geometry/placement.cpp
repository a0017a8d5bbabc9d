#include "geometry/placement.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

namespace ols {
namespace {

using Eigen::Matrix3d;

// A camera does not see what is nearer, least of all its own place.
constexpr double kNearest_m = 1.0;

// The trace of the inverse of what all stations tell, or nothing where that is singular but for
// rounding.
std::optional<double> squared_error_m2(const Matrix3d& information) {
  constexpr double kCondition = 1e13;
  const double squared = information.inverse().trace();
  if (!(squared > 0.0) || !(squared * information.trace() < kCondition)) return std::nullopt;
  return squared;
}

// The largest error alone gives the search no descent direction where several points share it: the
// power mean of this order stands for it.
constexpr double kOrder = 10.0;

struct Rated {
  Placement placement;
  double cost = 0.0;  // what the search makes least
};

// The information that every place gives about every point of the area.
class Search {
 public:
  explicit Search(const PlacementProblem& problem, TellStarts told = {})
      : problem_(problem), tell_(std::move(told)) {
    for (const PlannedTarget& target : problem.area) {
      Seen kept;
      for (const PlannedStation& station : problem.kept) kept += seen(station, target);
      kept_.push_back(kept);
    }
    for (const PlannedStation& place : problem.places) {
      tell();
      auto& row = places_.emplace_back();
      for (const PlannedTarget& target : problem.area) row.push_back(seen(place, target));
    }
  }

  Rated rate(const std::vector<std::size_t>& chosen) const {
    double sum = 0.0, worst = 0.0, powers = 0.0, points = 0.0;
    for (std::size_t point = 0; point < kept_.size(); ++point) {
      Seen total = kept_[point];
      for (const std::size_t place : chosen) total += places_[place][point];
      const auto known = squared_error_m2(total.information);
      if (!known && total.is_a_station) continue;
      const double squared = known.value_or(kUndetermined_m * kUndetermined_m);
      sum += squared;
      worst = std::max(worst, squared);
      powers += std::pow(squared, kOrder);
      points += 1.0;
    }
    points = std::max(1.0, points);
    const double mean_m = std::sqrt(sum / points), worst_m = std::sqrt(worst);
    const bool for_mean = problem_.goal == PlacementGoal::kMean;
    return {{chosen, mean_m, worst_m}, for_mean ? mean_m : std::pow(powers / points, 0.5 / kOrder)};
  }

  // Exchanges one place at a time until none helps.
  Rated improve(const std::vector<std::size_t>& chosen) {
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
    ++done_;
    return best;
  }

 private:
  // The stations' information about a point; a station at the point itself contributes none.
  struct Seen {
    Matrix3d information = Matrix3d::Zero();
    bool is_a_station = false;

    void operator+=(const Seen& other) {
      information += other.information;
      is_a_station = is_a_station || other.is_a_station;
    }
  };

  Seen seen(const PlannedStation& station, const PlannedTarget& target) const {
    if ((target.p_ecef - station.place.origin_ecef()).norm() < kNearest_m) {
      return {Matrix3d::Zero(), true};
    }
    const BearingPrecision precision = bearing_precision(station, target, problem_.exposures);
    return {bearing_information(precision, target.p_ecef), false};
  }

  Rated best_exchange(const Rated& from, std::size_t i) const {
    Rated best = from;
    std::vector<std::size_t> chosen = from.placement.chosen;
    for (std::size_t place = 0; place < places_.size(); ++place) {
      if (std::ranges::count(from.placement.chosen, place) > 0) continue;
      tell();
      chosen[i] = place;
      const Rated other = rate(chosen);
      if (other.cost < best.cost) best = other;
    }
    return best;
  }

  void tell() const {
    if (tell_) tell_(done_, static_cast<std::size_t>(problem_.starts));
  }

  const PlacementProblem& problem_;
  TellStarts tell_;
  std::size_t done_ = 0;                   // starts
  std::vector<Seen> kept_;                 // by point
  std::vector<std::vector<Seen>> places_;  // by place and point
};

void check(const PlacementProblem& problem) {
  if (problem.area.empty()) throw std::invalid_argument("the area has no point");
  if (problem.stations == 0) throw std::invalid_argument("there is no station to place");
  if (problem.places.size() < problem.stations) {
    throw std::invalid_argument("there are fewer places than stations");
  }
}

}  // namespace

Placement place_stations(const PlacementProblem& problem, std::mt19937_64& generator,
                         const TellStarts& tell) {
  check(problem);
  Search search(problem, tell);
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
