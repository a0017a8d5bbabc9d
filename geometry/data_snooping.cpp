#include "geometry/data_snooping.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/angles.h"
#include "geometry/chi_square.h"

namespace ols {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Twice the logarithm of odds of 1000 and of 20.
const double kNoDoubt = 2.0 * std::log(1000.0);
const double kLikely = 2.0 * std::log(20.0);

using Rest = Eigen::Matrix<double, kPoseUnknowns - 1, kPoseUnknowns - 1>;

// b^T N^-1 b. If the heading is undetermined, its term is left out.
double quadratic(const PoseInformation& N, const PoseUnknowns& b, double least_heading) {
  const auto cross = N.col(0).tail<kPoseUnknowns - 1>();
  const auto rest = b.tail<kPoseUnknowns - 1>();
  const auto solver = N.bottomRightCorner<kPoseUnknowns - 1, kPoseUnknowns - 1>().ldlt();
  const double heading = N(0, 0) - cross.dot(solver.solve(cross));
  const double of_rest = rest.dot(solver.solve(rest));
  if (!(heading > least_heading)) return of_rest;
  return of_rest + std::pow(b[0] - cross.dot(solver.solve(rest)), 2) / heading;
}

// Information about the heading below this value is rounding error.
double least_heading(const PoseInformation& N) {
  constexpr double kRounding = 1e-8;
  return kRounding / N.ldlt().solve(PoseUnknowns::Unit(0))[0];
}

}  // namespace

double leave_one_out(const LandmarkFit& fit, std::size_t landmark) {
  const LandmarkEquations& own = fit.landmarks[landmark];
  const double least = least_heading(fit.information);
  if (!fit.kept[landmark]) {
    return own.squares - quadratic(fit.information + own.information, own.gradient, least);
  }
  return own.squares + quadratic(fit.information - own.information, own.gradient, least);
}

double critical_value(const LandmarkAdjustment& adjustment, std::size_t landmark, double level) {
  const auto& landmarks = adjustment.landmarks();
  return chi_square_critical(level / static_cast<double>(landmarks.size()),
                             2 * static_cast<int>(landmarks[landmark].size()));
}

Eigen::Vector2d detectable_m(const LandmarkAdjustment& adjustment, const LandmarkFit& fit,
                             std::size_t landmark, double noncentrality) {
  constexpr double kUnchecked = 1e-6;
  const LandmarkEquations& own = fit.landmarks[landmark];
  PoseInformation N = fit.information;
  if (!fit.kept[landmark]) N += own.information;
  const std::size_t sighting = adjustment.landmarks()[landmark].front();
  Eigen::Vector2d result;
  for (int axis = 0; axis < 2; ++axis) {
    const PoseUnknowns pose = own.shift_pose.col(axis);
    const double checked = own.shift_information - pose.dot(N.ldlt().solve(pose));
    result[axis] = checked < kUnchecked * own.shift_information
                       ? kInfinity
                       : std::sqrt(noncentrality / checked) * adjustment.distance_m(sighting);
  }
  return result;
}

namespace {

class Snooping {
 public:
  Snooping(const LandmarkAdjustment& adjustment, double level)
      : adjustment_(adjustment), count_(adjustment.landmarks().size()) {
    for (std::size_t l = 0; l < count_; ++l) {
      critical_.push_back(critical_value(adjustment, l, level));
      headings_.push_back(adjustment.heading_by(l));
    }
  }

  // The sets grown from each heading that no earlier set explains, while at least `least` landmarks
  // are unexplained; the cheapest first.
  std::vector<LandmarkFit> candidates(const std::vector<bool>& among, double variance,
                                      std::size_t least) const {
    std::vector<LandmarkFit> found;
    std::vector<std::size_t> rest = set(among, true);
    while (rest.size() >= least) {
      const std::size_t seed = seed_of(rest);
      found.push_back(grown(seed, among, variance));
      const auto is_explained = [&](std::size_t l) { return l == seed || found.back().kept[l]; };
      std::erase_if(rest, is_explained);
    }
    std::ranges::stable_sort(found, {}, [&](const LandmarkFit& f) { return cost(f, variance); });
    return found;
  }

  double cost(const LandmarkFit& fit, double variance) const {
    double sum = fit.misfit;
    // -2 log likelihood at the best common factor of all variances.
    if (variance > 1.0 && fit.misfit > fit.redundancy) {
      sum = fit.redundancy * (1.0 + std::log(fit.misfit / fit.redundancy));
    }
    for (std::size_t l = 0; l < count_; ++l) sum += fit.kept[l] ? 0.0 : critical_[l];
    return sum;
  }

  static std::vector<std::size_t> set(const std::vector<bool>& kept, bool which) {
    std::vector<std::size_t> members;
    for (std::size_t l = 0; l < kept.size(); ++l) {
      if (kept[l] == which) members.push_back(l);
    }
    return members;
  }

  std::vector<std::size_t> failing(const LandmarkFit& fit, double variance) const {
    std::vector<std::size_t> kept = set(fit.kept, true);
    std::erase_if(kept,
                  [&](std::size_t l) { return leave_one_out(fit, l) <= variance * critical_[l]; });
    return kept;
  }

  // A rejected and a kept landmark that could be exchanged at nearly the same cost.
  std::optional<std::pair<std::size_t, std::size_t>> exchangeable(const LandmarkFit& fit) const {
    const double variance = std::max(1.0, fit.misfit / fit.redundancy);
    const double least = least_heading(fit.information);
    for (const std::size_t in : set(fit.kept, false)) {
      for (const std::size_t out : set(fit.kept, true)) {
        const LandmarkEquations &i = fit.landmarks[in], &o = fit.landmarks[out];
        const PoseInformation N = fit.information + i.information - o.information;
        const double more = i.squares - o.squares - quadratic(N, i.gradient - o.gradient, least);
        if (more < kNoDoubt * variance) return std::pair(in, out);
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
      const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
      std::ranges::nth_element(off, middle);
      if (*middle < least) {
        least = *middle;
        best = l;
      }
    }
    return best;
  }

  LandmarkFit grown(std::size_t seed, const std::vector<bool>& among, double variance) const {
    std::vector<bool> kept(count_, false);
    kept[seed] = true;
    LandmarkFit fit = adjustment_.fit(kept, headings_[seed]);
    for (std::size_t round = 0; round < 2 * count_; ++round) {
      if (!improve(kept, fit, among, variance)) break;
      fit = adjustment_.fit(kept, fit.station.chain.heading_rad);
    }
    return fit;
  }

  // Removes the worst landmark that fails, or adds all that pass.
  bool improve(std::vector<bool>& kept, const LandmarkFit& fit, const std::vector<bool>& among,
               double variance) const {
    std::size_t worst = count_, inside = 0;
    double worst_ratio = variance;
    std::vector<std::size_t> pass;
    for (std::size_t l = 0; l < count_; ++l) {
      if (!among[l]) continue;
      const double ratio = leave_one_out(fit, l) / critical_[l];
      if (kept[l]) ++inside;
      if (kept[l] && ratio > worst_ratio) {
        worst = l;
        worst_ratio = ratio;
      }
      if (!kept[l] && ratio <= variance) pass.push_back(l);
    }
    if (worst != count_ && inside > 1) {
      kept[worst] = false;
      return true;
    }
    for (const std::size_t l : pass) kept[l] = true;
    return !pass.empty();
  }

  const LandmarkAdjustment& adjustment_;
  std::size_t count_;
  std::vector<double> critical_, headings_;
};

std::vector<std::size_t> sightings_of(const LandmarkAdjustment& adjustment,
                                      const std::vector<std::size_t>& landmarks) {
  std::vector<std::size_t> all;
  for (const std::size_t l : landmarks) {
    const auto& sightings = adjustment.landmarks()[l];
    all.insert(all.end(), sightings.begin(), sightings.end());
  }
  std::ranges::sort(all);
  return all;
}

[[noreturn]] void contradict(const LandmarkAdjustment& adjustment, const std::string& why,
                             const std::vector<LandmarkFit>& fits) {
  constexpr std::size_t kMost = 5;
  std::vector<StationingAlternative> alternatives;
  for (const LandmarkFit& fit : fits) {
    if (alternatives.size() == kMost) break;
    alternatives.push_back({sightings_of(adjustment, Snooping::set(fit.kept, false)),
                            wrap_two_pi(fit.station.chain.heading_rad)});
  }
  throw LandmarksContradict(why, alternatives);
}

// Throws if the choice of mistaken landmarks is ambiguous.
void check(const LandmarkAdjustment& adjustment, const Snooping& snooping,
           const std::vector<LandmarkFit>& found, double variance) {
  const LandmarkFit& fit = found.front();
  const std::size_t aside = Snooping::set(fit.kept, false).size();
  const std::size_t inside = fit.kept.size() - aside;
  const auto failing = snooping.failing(fit, variance);
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
  for (const LandmarkFit& alternative : snooping.candidates(others, variance, group_size)) {
    if (Snooping::set(alternative.kept, true).size() < group_size) continue;
    contradict(adjustment, "two groups of landmarks contradict each other", {fit, alternative});
  }
  if (const auto exchange = snooping.exchangeable(fit)) {
    std::vector<bool> kept = fit.kept;
    kept[exchange->first] = true;
    kept[exchange->second] = false;
    contradict(adjustment, "the landmarks contradict each other",
               {fit, adjustment.fit(kept, fit.station.chain.heading_rad)});
  }
}

// All variances enlarged by a common factor, and the sets found under that assumption.
struct Hypothesis {
  double variance = 1.0;
  std::vector<LandmarkFit> found;
  double cost = 0.0;
};

Hypothesis hypothesis(const Snooping& snooping, const std::vector<bool>& among, double variance,
                      std::size_t least) {
  Hypothesis result{.variance = variance, .found = snooping.candidates(among, variance, least)};
  result.cost = snooping.cost(result.found.front(), variance);
  return result;
}

}  // namespace

LandmarkFit without_mistaken(const LandmarkAdjustment& adjustment, double level) {
  const Snooping snooping(adjustment, level);
  const std::vector<bool> all(adjustment.landmarks().size(), true);
  // With more landmarks than this, trying the first headings suffices: most landmarks agree.
  constexpr std::size_t kMany = 50;
  const std::size_t least = all.size() > kMany ? all.size() / 2 : 1;
  const Hypothesis stated = hypothesis(snooping, all, 1.0, least);
  Hypothesis noisier = stated;
  if (stated.found.front().kept != all) {
    for (const double variance : {4.0, 16.0, 64.0}) {
      Hypothesis more = hypothesis(snooping, all, variance, least);
      if (more.cost < noisier.cost) noisier = std::move(more);
    }
  }
  const double better = stated.cost - noisier.cost;
  try {
    const Hypothesis& best = better > kNoDoubt ? noisier : stated;
    check(adjustment, snooping, best.found, best.variance);
    return best.found.front();
  } catch (const LandmarksContradict&) {
    if (better > kNoDoubt || better < kLikely) throw;
  }
  check(adjustment, snooping, noisier.found, noisier.variance);
  return noisier.found.front();
}

}  // namespace ols
