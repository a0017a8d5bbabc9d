#include "calibration/calibrate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/parameter_change.h"
#include "calibration/snooping.h"
#include "conditions/printed.h"
#include "geometry/angles.h"
#include "geometry/chi_square.h"

namespace ols::calibration {
namespace {

// Nothing of a fit is accepted before this.
bool is_settled(const Fit& fit) { return fit.converged && is_finite(fit); }

std::string label(const Group& group) {
  return std::string(name(group.kind)) + (group.name.empty() ? "" : " '" + group.name + "'");
}

std::string listed(const std::vector<Group>& groups, const std::vector<std::size_t>& which) {
  std::string text;
  for (const std::size_t g : which) text += (text.empty() ? "" : ", ") + label(groups[g]);
  return text;
}

// Nothing but rectification targets and scenery: they are for the instrument.
bool tells_instrument_alone(const Adjustment& adjustment) {
  const auto& groups = adjustment.groups();
  const auto tells_heading = [](const Group& group) {
    return group.is_absolute() || group.kind == Kind::kTrack;
  };
  const auto tells_instrument = [](const Group& group) {
    return is_rectification_target(group.kind) || group.kind == Kind::kScene;
  };
  return std::ranges::none_of(groups, tells_heading) &&
         std::ranges::any_of(groups, tells_instrument);
}

// Those that are kept, or those that are rejected.
std::vector<std::size_t> tested_groups(const Adjustment& adjustment, const Fit& fit, bool kept) {
  std::vector<std::size_t> which;
  for (std::size_t g = 0; g < fit.kept.size(); ++g) {
    if (adjustment.groups()[g].is_tested() && fit.kept[g] == kept) which.push_back(g);
  }
  return which;
}

void check_majority(const Adjustment& adjustment, const Fit& fit) {
  const auto& groups = adjustment.groups();
  const std::vector<std::size_t> rejected = tested_groups(adjustment, fit, false);
  const std::vector<std::size_t> kept = tested_groups(adjustment, fit, true);
  if (rejected.empty() || kept.size() > rejected.size()) return;
  throw Contradiction(
      "the observations contradict each other: at least as many of them disagree as agree: " +
      listed(groups, kept) + "; against " + listed(groups, rejected));
}

void check_heading(const Adjustment& adjustment, const Fit& fit) {
  constexpr double kKnown_rad = 0.17;  // ten degrees
  const Layout& layout = adjustment.network().layout;
  const std::vector<std::size_t> rejected = tested_groups(adjustment, fit, false);
  for (std::size_t s = 0; s < layout.stations; ++s) {
    const int heading = layout.station(s) + kHeading;
    if (std::sqrt(fit.covariance(heading, heading)) < kKnown_rad) continue;
    throw std::invalid_argument("station '" + adjustment.network().names[s] +
                                "': the observations leave its heading unknown" +
                                (rejected.empty() ? ""
                                                  : ", without what was rejected as mistaken: " +
                                                        listed(adjustment.groups(), rejected)));
  }
}

// Another group whose rejection explains the observations as well.
void check_ambiguity(const Adjustment& adjustment, const Fit& fit, const Levels& levels) {
  const double kNoDoubt = 2.0 * std::log(1000.0);
  const auto& groups = adjustment.groups();
  const std::vector<std::size_t> rejected = tested_groups(adjustment, fit, false);
  if (rejected.size() != 1 || groups.size() > 40) return;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (!groups[g].is_tested() || g == rejected[0]) continue;
    std::vector<bool> other = fit.kept;
    other[rejected[0]] = true;
    other[g] = false;
    const Fit instead = adjustment.fit(fit.state, other);
    if (!is_settled(instead) || instead.misfit > fit.misfit + kNoDoubt) continue;
    const double worst = test_statistic(adjustment, instead, rejected[0]);
    if (worst > critical_value(groups[rejected[0]], groups.size(), levels.mistaken)) continue;
    throw Contradiction("the observations contradict each other: all others agree without " +
                        label(groups[rejected[0]]) + ", or without " + label(groups[g]));
  }
}

// What a block's squares are expected to be: its degrees of freedom less the share of the
// parameters that it determines itself (its partial redundancy, W. Foerstner 1979).
double redundancy_of(const Fit& fit, const BlockEquations& one, int degrees_of_freedom) {
  double share = 0.0;
  for (std::size_t k = 0; k < one.columns.size(); ++k) {
    for (std::size_t l = 0; l < one.columns.size(); ++l) {
      share += one.information(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l)) *
               fit.covariance(one.columns[l], one.columns[k]);
    }
  }
  return degrees_of_freedom - share;
}

// Without the scenery: robust weights have no chi-square, and its points are thousands.
ModelTest global_test(const Adjustment& adjustment, const Fit& fit, double level) {
  const Network& network = adjustment.network();
  std::vector<bool> counts(network.blocks.size(), false);
  for (std::size_t b = network.priors_from; b < counts.size(); ++b) counts[b] = true;
  for (std::size_t g = 0; g < network.groups.size(); ++g) {
    for (const std::size_t b : network.groups[g].blocks) {
      counts[b] = network.groups[g].is_tested() && fit.kept[g];
    }
  }
  double squares = 0.0, redundancy = 0.0;
  for (std::size_t b = 0; b < counts.size(); ++b) {
    if (!counts[b]) continue;
    squares += fit.equations[b].squares;
    redundancy += redundancy_of(fit, fit.equations[b], network.blocks[b]->degrees_of_freedom());
  }
  ModelTest test;
  test.redundancy = static_cast<int>(std::lround(redundancy));
  if (test.redundancy <= 0) return test;
  test.variance_factor = std::max(0.0, squares) / redundancy;
  test.critical = chi_square_critical(level, test.redundancy) / test.redundancy;
  return test;
}

void add_residuals(const Adjustment& adjustment, Calibration& result) {
  std::size_t most = 0;
  for (const Group& group : adjustment.groups()) {
    for (const std::size_t i : group.observations) most = std::max(most, i + 1);
  }
  result.residuals.resize(most);
  for (std::size_t g = 0; g < adjustment.groups().size(); ++g) {
    const Group& group = adjustment.groups()[g];
    std::size_t k = 0;
    for (const std::size_t b : group.blocks) {
      for (const Eigen::Vector2d& residual : result.fit.equations[b].residuals) {
        result.residuals[group.observations[k++]] = residual;
      }
    }
  }
}

// Scene points that a robust weight holds back: many of them, and the scene moves.
void remark_scene(const Adjustment& adjustment, Calibration& result) {
  constexpr double kMany = 0.2;
  for (const Group& group : adjustment.groups()) {
    if (group.is_tested()) continue;
    double all = 0.0, held = 0.0;
    for (const std::size_t b : group.blocks) {
      for (const double weight : result.fit.equations[b].weights) {
        all += 1.0;
        held += weight < 1.0 ? 1.0 : 0.0;
      }
    }
    if (held < kMany * all) continue;
    result.remarks.push_back(label(group) + ": " + std::to_string(std::lround(100.0 * held / all)) +
                             " % of its points do not stay where they are: does it move?");
  }
}

void remark_single(const Adjustment& adjustment, Calibration& result) {
  std::vector<std::size_t> kept;
  for (std::size_t g = 0; g < result.tests.size(); ++g) {
    if (adjustment.groups()[g].is_absolute() && result.fit.kept[g]) kept.push_back(g);
  }
  if (kept.size() != 1) return;
  result.remarks.push_back(label(adjustment.groups()[kept[0]]) +
                           " is the only reference: nothing checks it");
}

// A lens that was refocused: its focal length changes by half a thousandth and more, and the
// instrument says that it is known better.
void remark_focal(const Adjustment& adjustment, Calibration& result) {
  const Network& network = adjustment.network();
  for (std::size_t s = 0; s < network.stations.size(); ++s) {
    const ParameterChange change = parameter_change(network, result.fit, s, kFocal);
    if (!change.is_large()) continue;
    const std::string text = printed(
        "': its focal length is off by %.2f thousandths, %.1f sigma: was the lens refocused?",
        1e3 * change.by / network.stations[s].model.geometry.camera.fx_px, change.sigmas());
    result.remarks.push_back("station '" + network.names[s] + text);
  }
}

void remark_rejected(const Adjustment& adjustment, Calibration& result) {
  for (std::size_t g = 0; g < result.tests.size(); ++g) {
    if (!result.tests[g].rejected) continue;
    result.remarks.push_back(label(adjustment.groups()[g]) + " is rejected as mistaken");
  }
}

}  // namespace

double pose_scatter(const Adjustment& adjustment, const Fit& fit) {
  constexpr double kLevel = 0.01, kLeast = 10.0;
  const Network& network = adjustment.network();
  double squares = 0.0, redundancy = 0.0;
  for (std::size_t p = 0; p < network.layout.poses; ++p) {
    const std::size_t b = network.blocks.size() - network.layout.poses + p;  // the last blocks
    squares += fit.equations[b].squares;
    redundancy += redundancy_of(fit, fit.equations[b], network.blocks[b]->degrees_of_freedom());
  }
  if (redundancy < kLeast) return 1.0;
  const double critical = chi_square_critical(kLevel, static_cast<int>(std::lround(redundancy)));
  return squares > critical ? std::sqrt(squares / redundancy) : 1.0;
}

StationMatrix Calibration::covariance(const Network& network, std::size_t station) const {
  const int first = network.layout.station(station);
  return scaled_by * scaled_by *
         fit.covariance.block<kStationParameters, kStationParameters>(first, first);
}

Calibration calibrate(const Adjustment& adjustment, const Levels& levels,
                      const TellAdjusted& tell) {
  Calibration result;
  result.fit =
      snoop(adjustment, find_start(adjustment, levels.mistaken), {.level = levels.mistaken}, tell);
  if (!is_settled(result.fit)) throw std::invalid_argument("the adjustment does not converge");
  check_majority(adjustment, result.fit);
  result.headings_known = !tells_instrument_alone(adjustment);
  if (result.headings_known) {
    check_heading(adjustment, result.fit);
  } else {
    result.remarks.emplace_back(
        "the observations do not determine a heading: the result is an instrument without a setup");
  }
  check_ambiguity(adjustment, result.fit, levels);
  result.tests = tests_of(adjustment, result.fit, levels.mistaken);
  result.global = global_test(adjustment, result.fit, levels.misfit);
  if (result.global.variance_factor > result.global.critical) {
    result.scaled_by = std::sqrt(result.global.variance_factor);
    result.remarks.emplace_back(
        "the observations disagree by more than was stated: all deviations are scaled up");
  }
  remark_rejected(adjustment, result);
  remark_single(adjustment, result);
  remark_focal(adjustment, result);
  remark_scene(adjustment, result);
  add_residuals(adjustment, result);
  return result;
}

}  // namespace ols::calibration
