#include "calibration/mistaken_landmarks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "calibration/snooping.h"
#include "calibration/stationing.h"
#include "geometry/angles.h"
#include "geometry/median.h"

namespace ols::calibration {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Twice the logarithm of odds of 1000 and of 20.
const double kNoDoubt = 2.0 * std::log(1000.0);
const double kLikely = 2.0 * std::log(20.0);

double heading_of(const Fit& fit) { return fit.state.stations[0].model.geometry.chain.heading_rad; }

std::vector<std::size_t> members(const std::vector<bool>& kept, bool which) {
  std::vector<std::size_t> all;
  for (std::size_t l = 0; l < kept.size(); ++l) {
    if (kept[l] == which) all.push_back(l);
  }
  return all;
}

class LandmarkSearch {
 public:
  LandmarkSearch(const Adjustment& adjustment, double level)
      : adjustment_(adjustment), level_(level), count_(adjustment.groups().size()) {
    const Network& network = adjustment.network();
    const double rough_rad = network.stations[0].model.geometry.chain.heading_rad;
    const State rough = adjustment.start({rough_rad});
    for (const Group& group : adjustment.groups()) {
      const std::size_t block = group.blocks.front();
      critical_.push_back(critical_value(group, count_, level));
      headings_.push_back(network.blocks[block]->heading(rough, block).value_or(rough_rad));
    }
  }

  const Adjustment& adjustment() const { return adjustment_; }

  // The sets found from each heading that no earlier set explains, while at least `least` landmarks
  // are unexplained; the cheapest first.
  std::vector<Fit> candidates(const std::vector<bool>& among, double variance,
                              std::size_t least) const {
    std::vector<Fit> found;
    std::vector<std::size_t> rest = members(among, true);
    while (rest.size() >= least) {
      const std::size_t seed = seed_of(rest);
      found.push_back(found_from(seed, among, variance));
      const auto is_explained = [&](std::size_t l) { return l == seed || found.back().kept[l]; };
      std::erase_if(rest, is_explained);
    }
    std::ranges::stable_sort(found, {}, [&](const Fit& fit) { return cost(fit, variance); });
    return found;
  }

  double cost(const Fit& fit, double variance) const {
    const double redundancy = stationing_redundancy(adjustment_, fit.kept);
    double sum = fit.misfit;
    // -2 log likelihood at the best common factor of all variances.
    if (variance > 1.0 && fit.misfit > redundancy) {
      sum = redundancy * (1.0 + std::log(fit.misfit / redundancy));
    }
    for (const std::size_t l : members(fit.kept, false)) sum += critical_[l];
    return sum;
  }

  std::vector<std::size_t> failing(const Fit& fit, double variance) const {
    std::vector<std::size_t> kept = members(fit.kept, true);
    std::erase_if(kept, [&](std::size_t l) {
      return test_statistic(adjustment_, fit, l) <= variance * critical_[l];
    });
    return kept;
  }

  // A rejected and a kept landmark that could be exchanged at nearly the same cost.
  std::optional<std::pair<std::size_t, std::size_t>> exchangeable(const Fit& fit) const {
    const double variance =
        std::max(1.0, fit.misfit / stationing_redundancy(adjustment_, fit.kept));
    for (const std::size_t in : members(fit.kept, false)) {
      const BlockEquations then = adjustment_.equations(fit, in);
      if (!then.valid) continue;
      for (const std::size_t out : members(fit.kept, true)) {
        const double less = replacement_statistic(fit, adjustment_.equations(fit, out), then);
        if (-less < kNoDoubt * variance) return std::pair(in, out);
      }
    }
    return std::nullopt;
  }

 private:
  // The heading with the least median difference from the others (P. Rousseeuw, 1984).
  std::size_t seed_of(const std::vector<std::size_t>& rest) const {
    std::size_t best = rest.front();
    double least = kInfinity;
    std::vector<double> off(rest.size());
    for (const std::size_t l : rest) {
      std::ranges::transform(rest, off.begin(), [&](std::size_t other) {
        return std::abs(wrap_pi(headings_[other] - headings_[l]));
      });
      if (const double middle = median(off); middle < least) {
        least = middle;
        best = l;
      }
    }
    return best;
  }

  Fit found_from(std::size_t seed, const std::vector<bool>& among, double variance) const {
    Start start = start_at(adjustment_, {headings_[seed]}, level_, variance);
    for (std::size_t l = 0; l < count_; ++l) start.kept[l] = start.kept[l] && among[l];
    start.kept[seed] = true;
    const Fit fit = snoop(adjustment_, start, {level_, variance, among});
    if (!members(fit.kept, true).empty()) return fit;
    std::vector<bool> alone(count_, false);
    alone[seed] = true;
    return adjustment_.fit(start.state, alone);
  }

  const Adjustment& adjustment_;
  double level_;
  std::size_t count_;
  std::vector<double> critical_, headings_;
};

std::vector<std::size_t> sightings_of(const Adjustment& adjustment,
                                      const std::vector<std::size_t>& landmarks) {
  std::vector<std::size_t> all;
  for (const std::size_t l : landmarks) {
    const auto& sightings = adjustment.groups()[l].observations;
    all.insert(all.end(), sightings.begin(), sightings.end());
  }
  std::ranges::sort(all);
  return all;
}

[[noreturn]] void contradict(const Adjustment& adjustment, const std::string& why,
                             const std::vector<Fit>& fits) {
  constexpr std::size_t kMost = 5;
  std::vector<StationingAlternative> alternatives;
  for (const Fit& fit : fits) {
    if (alternatives.size() == kMost) break;
    alternatives.push_back(
        {sightings_of(adjustment, members(fit.kept, false)), wrap_two_pi(heading_of(fit))});
  }
  throw LandmarksContradict(why, alternatives);
}

// Throws if the choice of mistaken landmarks is ambiguous.
void check(const LandmarkSearch& search, const std::vector<Fit>& found, double variance) {
  const Adjustment& adjustment = search.adjustment();
  const Fit& fit = found.front();
  const std::size_t aside = members(fit.kept, false).size();
  const std::size_t inside = fit.kept.size() - aside;
  const auto failing = search.failing(fit, variance);
  if (!failing.empty()) {
    throw LandmarksContradict(
        "sightings contradict each other, or the stated tilt, mounting or position of the station",
        {}, sightings_of(adjustment, failing));
  }
  if (aside == 0) return;
  if (inside <= aside) contradict(adjustment, "the landmarks contradict each other", found);
  std::vector<bool> others = fit.kept;
  others.flip();
  const std::size_t group_size = std::max<std::size_t>(2, (inside + 1) / 2);
  for (const Fit& alternative : search.candidates(others, variance, group_size)) {
    if (members(alternative.kept, true).size() < group_size) continue;
    contradict(adjustment, "two groups of landmarks contradict each other", {fit, alternative});
  }
  if (const auto exchange = search.exchangeable(fit)) {
    std::vector<bool> kept = fit.kept;
    kept[exchange->first] = true;
    kept[exchange->second] = false;
    contradict(adjustment, "the landmarks contradict each other",
               {fit, adjustment.fit(fit.state, kept)});
  }
}

// All variances enlarged by a common factor, and the sets found under that assumption.
struct Hypothesis {
  double variance = 1.0;
  std::vector<Fit> found;
  double cost = 0.0;
};

Hypothesis hypothesis(const LandmarkSearch& search, const std::vector<bool>& among, double variance,
                      std::size_t least) {
  Hypothesis result{.variance = variance, .found = search.candidates(among, variance, least)};
  result.cost = search.cost(result.found.front(), variance);
  return result;
}

}  // namespace

int stationing_redundancy(const Adjustment& adjustment, const std::vector<bool>& kept) {
  int redundancy = -1;  // the heading
  for (const std::size_t l : members(kept, true)) {
    redundancy += adjustment.groups()[l].degrees_of_freedom;
  }
  return redundancy;
}

Fit without_mistaken(const Adjustment& adjustment, double level) {
  const LandmarkSearch search(adjustment, level);
  const std::vector<bool> all(adjustment.groups().size(), true);
  // With more landmarks than this, trying the first headings suffices: most landmarks agree.
  constexpr std::size_t kMany = 50;
  const std::size_t least = all.size() > kMany ? all.size() / 2 : 1;
  const Hypothesis stated = hypothesis(search, all, 1.0, least);
  Hypothesis noisier = stated;
  if (stated.found.front().kept != all) {
    for (const double variance : {4.0, 16.0, 64.0}) {
      Hypothesis more = hypothesis(search, all, variance, least);
      if (more.cost < noisier.cost) noisier = std::move(more);
    }
  }
  const double better = stated.cost - noisier.cost;
  try {
    const Hypothesis& best = better > kNoDoubt ? noisier : stated;
    check(search, best.found, best.variance);
    return best.found.front();
  } catch (const LandmarksContradict&) {
    if (better > kNoDoubt || better < kLikely) throw;
  }
  check(search, noisier.found, noisier.variance);
  return noisier.found.front();
}

}  // namespace ols::calibration
