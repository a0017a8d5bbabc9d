#include "geometry/placement.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

namespace ols {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// A camera does not see what is nearer, least of all its own place.
constexpr double kNearest_m = 1.0;

// What stations tell about a point: the six elements of a symmetric matrix. Nearly all of a search
// is adding and inverting them.
struct Information {
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;  // [1/m^2]
  bool is_a_station = false;                                          // one stands at the point

  void operator+=(const Information& other) {
    xx += other.xx;
    xy += other.xy;
    xz += other.xz;
    yy += other.yy;
    yz += other.yz;
    zz += other.zz;
    is_a_station = is_a_station || other.is_a_station;
  }
  // The trace of the inverse, or nothing where the matrix is singular but for rounding.
  std::optional<double> squared_error_m2() const {
    constexpr double kCondition = 1e13;
    const double minor_x = yy * zz - yz * yz;
    const double minors = minor_x + xx * zz - xz * xz + xx * yy - xy * xy;
    const double determinant = xx * minor_x - xy * (xy * zz - xz * yz) + xz * (xy * yz - xz * yy);
    const double squared = minors / determinant;
    if (!(squared > 0.0) || !(squared * (xx + yy + zz) < kCondition)) return std::nullopt;
    return squared;
  }
};

Information operator+(Information sum, const Information& other) {
  sum += other;
  return sum;
}

using OverArea = std::vector<Information>;  // by point

enum class Measure { kMean, kPowerMean, kWorst };

struct Cost {
  std::size_t undetermined = 0;
  double value = 0.0;
  auto operator<=>(const Cost&) const = default;
};

// The points of the area, one after the other.
struct Tally {
  double within_m2;
  std::size_t undetermined = 0, points = 0;
  double squares = 0.0, powers = 0.0, worst = 0.0;

  void add(const Information& information) {
    const auto squared = information.squared_error_m2();
    if (!squared || *squared > within_m2) {
      undetermined += information.is_a_station ? 0 : 1;
      return;
    }
    ++points;
    squares += *squared;
    const double fourth = *squared * *squared, eighth = fourth * fourth;
    powers += eighth * fourth * eighth;  // the tenth power of a square
    worst = std::max(worst, *squared);
  }
  // `of` points: no more than these are determined in the end, so that this is a lower bound.
  Cost cost(Measure measure, std::size_t of) const {
    if (of == 0) return {undetermined, undetermined > 0 ? kInfinite : 0.0};
    const auto n = static_cast<double>(of);
    switch (measure) {
      case Measure::kMean:
        return {undetermined, squares / n};
      case Measure::kPowerMean:
        return {undetermined, powers / n};
      case Measure::kWorst:
        break;
    }
    return {undetermined, worst};
  }
};

class Search {
 public:
  explicit Search(const PlacementProblem& problem, TellStarts told = {})
      : problem_(problem),
        tell_(std::move(told)),
        within_m2_(problem.within_m * problem.within_m),
        kept_(problem.area.size()) {
    for (const PlannedStation& station : problem.kept) add(seen(station), kept_);
    for (const PlannedStation& place : problem.places) {
      tell();
      places_.push_back(seen(place));
    }
  }

  Placement rate(const std::vector<std::size_t>& chosen) const {
    Tally tally{within_m2_};
    for (const Information& information : told_by(chosen, chosen.size())) tally.add(information);
    const auto root = [&](Measure measure) {
      return std::sqrt(tally.cost(measure, tally.points).value);
    };
    return {chosen, tally.undetermined, root(Measure::kMean), root(Measure::kWorst)};
  }

  // Exchanges one place at a time until none helps.
  Placement improve(std::vector<std::size_t> chosen) {
    if (problem_.goal == PlacementGoal::kMean) {
      descend(chosen, Measure::kMean);
    } else {
      descend(chosen, Measure::kPowerMean);
      descend(chosen, Measure::kWorst);
    }
    std::ranges::sort(chosen);
    ++done_;
    return rate(chosen);
  }

 private:
  OverArea seen(const PlannedStation& station) const {
    OverArea row;
    for (const PlannedTarget& target : problem_.area) {
      Information& told = row.emplace_back();
      if ((target.p_ecef - station.place.origin_ecef()).norm() < kNearest_m) {
        told.is_a_station = true;
      } else if (station.in_sight(target.p_ecef)) {
        const BearingPrecision precision = bearing_precision(station, target, problem_.exposures);
        const Eigen::Matrix3d m = bearing_information(precision, target.p_ecef);
        told = {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
      }
    }
    return row;
  }

  static void add(const OverArea& told, OverArea& sum) {
    for (std::size_t point = 0; point < sum.size(); ++point) sum[point] += told[point];
  }

  // By the stations in place and the chosen ones but the one at `without`.
  OverArea told_by(const std::vector<std::size_t>& chosen, std::size_t without) const {
    OverArea sum = kept_;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (i != without) add(places_[chosen[i]], sum);
    }
    return sum;
  }

  // Nothing if it is not below `limit`.
  std::optional<Cost> cost_below(const Cost& limit, const OverArea& others, std::size_t place,
                                 Measure measure) const {
    constexpr std::size_t kLookAfter = 16;
    const OverArea& added = places_[place];
    Tally tally{within_m2_};
    for (std::size_t point = 0; point < others.size(); ++point) {
      tally.add(others[point] + added[point]);
      if (point % kLookAfter == 0 && tally.cost(measure, others.size()) >= limit) return {};
    }
    const Cost cost = tally.cost(measure, tally.points);
    return cost < limit ? std::optional(cost) : std::nullopt;
  }

  void descend(std::vector<std::size_t>& chosen, Measure measure) const {
    constexpr double kWorthIt = 1.0 - 1e-9;
    Cost least{problem_.area.size() + 1, kInfinite};
    std::size_t unchanged = 0;
    for (std::size_t i = 0; unchanged < chosen.size(); i = (i + 1) % chosen.size()) {
      const OverArea others = told_by(chosen, i);
      least = cost_below({problem_.area.size() + 1, 0.0}, others, chosen[i], measure).value();
      ++unchanged;
      for (std::size_t place = 0; place < places_.size(); ++place) {
        if (std::ranges::count(chosen, place) > 0) continue;
        tell();
        const Cost limit{least.undetermined, kWorthIt * least.value};
        const auto better = cost_below(limit, others, place, measure);
        if (!better) continue;
        least = *better;
        chosen[i] = place;
        unchanged = 0;
      }
    }
  }

  void tell() const {
    if (tell_) tell_(done_, static_cast<std::size_t>(problem_.starts));
  }

  const PlacementProblem& problem_;
  TellStarts tell_;
  double within_m2_;
  std::size_t done_ = 0;  // starts
  OverArea kept_;
  std::vector<OverArea> places_;
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
  const auto cost = [&](const Placement& one) {
    return Cost{one.undetermined, problem.goal == PlacementGoal::kMean ? one.mean_m : one.worst_m};
  };
  std::optional<Placement> best;
  for (int start = 0; start < problem.starts; ++start) {
    std::ranges::shuffle(order, generator);
    const auto count = static_cast<std::ptrdiff_t>(problem.stations);
    Placement found = search.improve({order.begin(), order.begin() + count});
    if (!best || cost(found) < cost(*best)) best = std::move(found);
  }
  return best.value();
}

Placement rate_placement(const PlacementProblem& problem, std::vector<std::size_t> chosen) {
  check(problem);
  for (const std::size_t place : chosen) {
    if (place >= problem.places.size()) throw std::invalid_argument("there is no such place");
  }
  return Search(problem).rate(chosen);
}

}  // namespace ols
