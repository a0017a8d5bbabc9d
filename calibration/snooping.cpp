#include "calibration/snooping.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "geometry/angles.h"
#include "geometry/chi_square.h"

namespace ols::calibration {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

MatrixXd part_of(const MatrixXd& all, const std::vector<int>& columns) {
  const auto size = static_cast<Index>(columns.size());
  MatrixXd part(size, size);
  for (Index k = 0; k < size; ++k) {
    for (Index l = 0; l < size; ++l) {
      part(k, l) = all(columns[static_cast<std::size_t>(k)], columns[static_cast<std::size_t>(l)]);
    }
  }
  return part;
}

// The square roots of the variances, 1 for what is known: the numbers below differ by many orders.
VectorXd scale_of(const MatrixXd& C) {
  return C.diagonal().unaryExpr([](double v) { return v > 0.0 ? std::sqrt(v) : 1.0; });
}

// A = U U' and g = U h: two columns for a sighting of dozens of parameters, as many as A has rank.
struct Root {
  MatrixXd U;
  VectorXd h;
};

// Of the equations of a group, by Cholesky's decomposition with the largest pivot first. The
// numbers are of many orders: they are compared by the deviations of the parameters, of the
// covariance C.
Root root_of(const BlockEquations& group, const MatrixXd& C) {
  const VectorXd scale = scale_of(C);
  MatrixXd A = scale.asDiagonal() * group.information * scale.asDiagonal();
  VectorXd g = scale.asDiagonal() * group.gradient;
  const Index size = A.rows();
  Root root{MatrixXd(size, size), VectorXd(size)};
  const double least =
      static_cast<double>(size) * std::numeric_limits<double>::epsilon() * A.diagonal().maxCoeff();
  Index rank = 0, k = 0;
  while (rank < size && A.diagonal().maxCoeff(&k) > least) {
    root.U.col(rank) = A.col(k) / std::sqrt(A(k, k));
    root.h[rank] = g[k] / root.U(k, rank);
    A.noalias() -= root.U.col(rank) * root.U.col(rank).transpose();
    g -= root.h[rank] * root.U.col(rank);
    ++rank;
  }
  return {scale.cwiseInverse().asDiagonal() * root.U.leftCols(rank), root.h.head(rank)};
}

// g' (N + U S U')^-1 g with the covariance C of N, the signs S and g = U h, by Woodbury's identity.
double squares_of(const MatrixXd& C, const Root& root, const VectorXd& signs) {
  const MatrixXd K = root.U.transpose() * (C * root.U);
  const MatrixXd M = MatrixXd(signs.asDiagonal()) + K;
  return root.h.dot(K * M.partialPivLu().solve(signs.cwiseProduct(root.h)));
}

// squares - sign g' (N + sign N_g)^-1 g with the covariance C of N; sign -1 leaves the group out.
double change_of_misfit(const MatrixXd& C, const BlockEquations& group, double sign) {
  const Root root = root_of(group, C);
  return group.squares - sign * squares_of(C, root, VectorXd::Constant(root.h.size(), sign));
}

// The prior covariance with the heading known to some degrees: for the agreement of groups with a
// heading that is being tried.
MatrixXd prior_covariance(const Adjustment& adjustment) {
  const Network& network = adjustment.network();
  const Layout& layout = network.layout;
  MatrixXd C = MatrixXd::Zero(layout.size(), layout.size());
  for (std::size_t s = 0; s < layout.stations; ++s) {
    StationMatrix prior = network.stations[s].covariance;
    constexpr double kTried_rad = 0.01;
    prior.row(kHeading).setZero();
    prior.col(kHeading).setZero();
    prior(kHeading, kHeading) =
        kTried_rad * kTried_rad + prior(kTiltX, kTiltX) + prior(kTiltY, kTiltY);
    C.block<kStationParameters, kStationParameters>(layout.station(s), layout.station(s)) = prior;
    C(layout.ut1(), layout.ut1()) = 1.0;
  }
  for (std::size_t p = 0; p < layout.poses; ++p) {
    constexpr double kPose_rad = 1e-4;
    C(layout.pose(p), layout.pose(p)) = kPose_rad * kPose_rad;
    C(layout.pose(p) + 1, layout.pose(p) + 1) = kPose_rad * kPose_rad;
  }
  return C;
}

// Which of the groups agree with a state, by the priors.
class Agreement {
 public:
  Agreement(const Adjustment& adjustment, double level, double variance = 1.0)
      : adjustment_(adjustment),
        level_(level),
        variance_(variance),
        prior_(prior_covariance(adjustment)) {}

  struct Vote {
    int agree = 0;
    double misfit = 0.0;
    bool operator<(const Vote& other) const {
      return agree != other.agree ? agree > other.agree : misfit < other.misfit;
    }
  };
  // One serves all groups: where each of thousands of sightings is a group, a copy of the state for
  // each takes minutes.
  Fit begin_at(State state) const {
    Fit at;
    at.state = std::move(state);
    at.equations.resize(adjustment_.network().blocks.size());
    return at;
  }
  bool agrees(Fit& at, std::size_t group, double& misfit) const {
    const Group& one = adjustment_.groups()[group];
    bool valid = true;
    for (const std::size_t b : one.blocks) {
      at.equations[b] = adjustment_.network().blocks[b]->equations(at.state, b, 0.0);
      valid = valid && at.equations[b].valid;
    }
    const BlockEquations equations = valid ? adjustment_.equations(at, group) : BlockEquations();
    // Kept, they need 10 kB for each group.
    for (const std::size_t b : one.blocks) at.equations[b] = BlockEquations();
    if (!valid) return false;
    misfit = change_of_misfit(part_of(prior_, equations.columns), equations, 1.0);
    // Linearised far from the solution: generous.
    return misfit < 4.0 * variance_ * critical_value(one, adjustment_.groups().size(), level_);
  }
  Vote vote(State state, const std::vector<std::size_t>& groups) const {
    Vote vote;
    Fit at = begin_at(std::move(state));
    for (const std::size_t g : groups) {
      double misfit = 0.0;
      if (!agrees(at, g, misfit)) continue;
      ++vote.agree;
      vote.misfit += misfit;
    }
    return vote;
  }

 private:
  const Adjustment& adjustment_;
  double level_, variance_;
  MatrixXd prior_;
};

constexpr int kMostTries = 40;

// Whether so many tries suffice: as sure as kMostTries are where half of the groups are mistaken,
// if those that do not agree with the best heading, and one more, are.
bool are_enough(int tries, int agree, std::size_t groups) {
  const double mistaken = 1.0 - agree / (1.0 + static_cast<double>(groups));
  return tries * std::log2(mistaken) <= -kMostTries;
}

std::vector<double> headings_tried(const Adjustment& adjustment, const State& state,
                                   const std::vector<std::size_t>& groups) {
  // Each try asks all groups. So many, from all of them evenly, cannot all be mistaken: of a round
  // in which half are, one in a million millions.
  const std::size_t tries = std::min<std::size_t>(kMostTries, groups.size());
  std::vector<std::size_t> order(tries);
  std::iota(order.begin(), order.end(), 0);
  // By the golden section: whoever stops early has asked all parts of the round.
  std::ranges::sort(order, {}, [](std::size_t i) {
    return std::fmod(std::numbers::phi * static_cast<double>(i), 1.0);
  });
  std::vector<double> headings;
  for (const std::size_t i : order) {
    const std::size_t g = groups[i * groups.size() / tries];
    const std::size_t block = adjustment.groups()[g].blocks.front();
    const auto heading = adjustment.network().blocks[block]->heading(state, block);
    if (heading) headings.push_back(*heading);
  }
  return headings;
}

constexpr double kUnchecked = 1e-6;  // of the group's own information

std::vector<double> stated_headings(const Adjustment& adjustment) {
  std::vector<double> headings;
  for (const StationPrior& station : adjustment.network().stations) {
    headings.push_back(station.model.geometry.chain.heading_rad);
  }
  return headings;
}

// From the station's own sightings alone: those of others cannot be judged before their headings
// are known.
double heading_of(const Adjustment& adjustment, std::size_t station, double level) {
  const Adjustment own(alone(adjustment.network(), station));
  const Agreement agreement(own, level);
  std::vector<std::size_t> groups;
  for (std::size_t g = 0; g < own.groups().size(); ++g) {
    if (own.groups()[g].is_absolute()) groups.push_back(g);
  }
  std::vector<double> headings = stated_headings(own);
  double heading = headings[station];
  Agreement::Vote best{-1, 0.0};
  int tries = 0;
  for (const double tried : headings_tried(own, own.start(headings), groups)) {
    if (are_enough(tries++, std::max(0, best.agree), groups.size())) break;
    headings[station] = tried;
    const Agreement::Vote vote = agreement.vote(own.start(headings), groups);
    if (!(vote < best)) continue;
    best = vote;
    heading = tried;
  }
  return heading;
}

class Snooping {
 public:
  Snooping(const Adjustment& adjustment, const Search& search)
      : adjustment_(adjustment), search_(search) {}

  Fit run(const Start& start, const TellAdjusted& tell) {
    Fit fit = adjustment_.fit(start.state, start.kept);
    // Observations that contradict each other may not converge before some are rejected.
    while (is_finite(fit) && tried_.insert(fit.kept).second) {
      if (tell) tell();
      const auto change = next_change(fit);
      if (!change) break;
      std::vector<bool> kept = fit.kept;
      kept[*change].flip();
      fit = adjustment_.fit(fit.state, kept);
    }
    return fit;
  }

 private:
  bool is_judged(std::size_t g) const {
    return adjustment_.groups()[g].is_tested() && (search_.among.empty() || search_.among[g]);
  }
  double over_critical(const Fit& fit, std::size_t g) const {
    const auto& groups = adjustment_.groups();
    return test_statistic(adjustment_, fit, g) /
           (search_.variance * critical_value(groups[g], groups.size(), search_.level));
  }
  // First what passes is taken back, the best first: the heading may rest on one group yet.
  std::optional<std::size_t> next_change(const Fit& fit) const {
    std::optional<std::size_t> best, worst;
    double least = 1.0, most = 1.0;
    for (std::size_t g = 0; g < fit.kept.size(); ++g) {
      if (!is_judged(g)) continue;
      const double over = over_critical(fit, g);
      if (!fit.kept[g] && over < least) {
        best = g;
        least = over;
      } else if (fit.kept[g] && over > most) {
        worst = g;
        most = over;
      }
    }
    if (best && !after(fit.kept, *best)) return best;
    return worst;
  }
  bool after(std::vector<bool> kept, std::size_t g) const {
    kept[g].flip();
    return tried_.contains(kept);
  }

  const Adjustment& adjustment_;
  const Search& search_;
  std::set<std::vector<bool>> tried_;
};

}  // namespace

double critical_value(const Group& group, std::size_t groups, double level) {
  return chi_square_critical(level / static_cast<double>(groups),
                             std::max(1, group.degrees_of_freedom));
}

double test_statistic(const Adjustment& adjustment, const Fit& fit, std::size_t group) {
  const BlockEquations equations = adjustment.equations(fit, group);
  if (!equations.valid) return std::numeric_limits<double>::infinity();
  const double sign = fit.kept[group] ? -1.0 : 1.0;
  const double change =
      change_of_misfit(part_of(fit.covariance, equations.columns), equations, sign);
  // What cannot be computed does not pass.
  return std::isnan(change) ? std::numeric_limits<double>::infinity() : change;
}

double replacement_statistic(const Fit& fit, const BlockEquations& now,
                             const BlockEquations& then) {
  const MatrixXd C = part_of(fit.covariance, now.columns);
  const Root in = root_of(then, C), out = root_of(now, C);
  Root both{MatrixXd(in.U.rows(), in.U.cols() + out.U.cols()),
            VectorXd(in.h.size() + out.h.size())};
  both.U << in.U, out.U;
  both.h << -in.h, out.h;
  VectorXd signs = VectorXd::Ones(both.h.size());
  signs.tail(out.h.size()) *= -1.0;
  return now.squares - then.squares + squares_of(C, both, signs);
}

Vector2d detectable_rad(const Adjustment& adjustment, const Fit& fit, std::size_t group,
                        double noncentrality) {
  const BlockEquations equations = adjustment.equations(fit, group);
  Vector2d result = Vector2d::Constant(std::numeric_limits<double>::infinity());
  if (!equations.valid || equations.shift_by.rows() == 0) return result;
  const MatrixXd C = part_of(fit.covariance, equations.columns);
  const Eigen::Matrix2d own = equations.shift_information;
  const Eigen::Matrix2d lost = equations.shift_by.transpose() * C * equations.shift_by;
  for (Index k = 0; k < 2; ++k) {
    const double left =
        fit.kept[group] ? own(k, k) - lost(k, k) : own(k, k) * own(k, k) / (own(k, k) + lost(k, k));
    if (left > kUnchecked * own(k, k)) result[k] = std::sqrt(noncentrality / left);
  }
  return result;
}

std::optional<Bias> bias_without(const Adjustment& adjustment, const Fit& fit, std::size_t group) {
  const BlockEquations equations = adjustment.equations(fit, group);
  if (!fit.kept[group] || !equations.valid || equations.shift_by.rows() == 0) return std::nullopt;
  const MatrixXd C = part_of(fit.covariance, equations.columns);
  const Eigen::Matrix2d own = equations.shift_information;
  const Eigen::Matrix2d left = own - equations.shift_by.transpose() * C * equations.shift_by;
  if ((left.diagonal().array() < kUnchecked * own.diagonal().array()).any() ||
      !(left.determinant() > 0.0)) {
    return std::nullopt;
  }
  const Eigen::Matrix2d covariance = left.inverse();
  Bias bias;
  bias.rad = -covariance * equations.shift_gradient;
  bias.sigmas = (bias.rad.array() / covariance.diagonal().array().sqrt()).abs().maxCoeff();
  return bias;
}

std::vector<GroupTest> tests_of(const Adjustment& adjustment, const Fit& fit, double level) {
  constexpr double kPower = 0.8;
  std::vector<GroupTest> tests(adjustment.groups().size());
  for (std::size_t g = 0; g < tests.size(); ++g) {
    const Group& group = adjustment.groups()[g];
    if (!group.is_tested()) continue;
    const double critical = critical_value(group, tests.size(), level);
    tests[g].rejected = !fit.kept[g];
    tests[g].w = std::sqrt(std::max(0.0, test_statistic(adjustment, fit, g)));
    tests[g].critical = std::sqrt(critical);
    tests[g].detectable_rad = detectable_rad(
        adjustment, fit, g,
        least_noncentrality(critical, std::max(1, group.degrees_of_freedom), kPower));
  }
  return tests;
}

Start start_at(const Adjustment& adjustment, const std::vector<double>& headings_rad, double level,
               double variance) {
  const Agreement agreement(adjustment, level, variance);
  Start start{adjustment.start(headings_rad), std::vector<bool>(adjustment.groups().size(), true)};
  Fit at = agreement.begin_at(start.state);
  for (std::size_t g = 0; g < start.kept.size(); ++g) {
    double misfit = 0.0;
    const Group& group = adjustment.groups()[g];
    if (group.is_absolute()) start.kept[g] = agreement.agrees(at, g, misfit);
  }
  return start;
}

Start find_start(const Adjustment& adjustment, double level) {
  std::vector<double> headings = stated_headings(adjustment);
  for (std::size_t s = 0; s < headings.size(); ++s) {
    headings[s] = heading_of(adjustment, s, level);
  }
  return start_at(adjustment, headings, level);
}

bool is_finite(const Fit& fit) {
  return std::isfinite(fit.misfit) && fit.covariance.allFinite() &&
         (fit.covariance.diagonal().array() >= 0.0).all();
}

Fit snoop(const Adjustment& adjustment, const Start& start, const Search& search,
          const TellAdjusted& tell) {
  return Snooping(adjustment, search).run(start, tell);
}

}  // namespace ols::calibration
