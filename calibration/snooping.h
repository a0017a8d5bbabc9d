// Statistical tests of an adjustment's groups of observations, computed from its normal equations.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "calibration/adjustment.h"

namespace ols::calibration {

// The decrease of the misfit when a kept group is left out, or its increase when a rejected group
// is added: a chi-square with the group's degrees of freedom.
double test_statistic(const Adjustment& adjustment, const Fit& fit, std::size_t group);

// The same for a part of a block: the decrease of the misfit when the equations `now` are replaced
// by `then`, over the same columns. Negative if the misfit grows.
double replacement_statistic(const Fit& fit, const BlockEquations& now, const BlockEquations& then);

// The bias of a direction (across, up) that the group's test can detect at this noncentrality.
Eigen::Vector2d detectable_rad(const Adjustment& adjustment, const Fit& fit, std::size_t group,
                               double noncentrality);

// The offset of a kept group's target from the place that all other groups predict, as seen from
// the station. nullopt if no other group checks the target.
struct Bias {
  Eigen::Vector2d rad = Eigen::Vector2d::Zero();  // across, up
  double sigmas = 0.0;                            // of the larger component
};
std::optional<Bias> bias_without(const Adjustment& adjustment, const Fit& fit, std::size_t group);

// The critical value of a group's test.
double critical_value(const Group& group, std::size_t groups, double level);

// The tests of all groups; zeros for untested groups.
struct GroupTest {
  bool rejected = false;
  double w = 0.0;  // root of a chi-square with the group's degrees of freedom
  double critical = 0.0;
  // Minimal detectable bias (power 80 %) of the direction to the target: across, up. Infinite if
  // the other groups do not check it.
  Eigen::Vector2d detectable_rad = Eigen::Vector2d::Zero();
};

std::vector<GroupTest> tests_of(const Adjustment& adjustment, const Fit& fit, double level);

// Where the adjustment starts: the stations' headings, and the groups that agree with the priors at
// these headings.
struct Start {
  State state;
  std::vector<bool> kept;
};
// `variance`: the ratio of actual to stated variance, for all observations.
Start start_at(const Adjustment& adjustment, const std::vector<double>& headings_rad, double level,
               double variance = 1.0);
// The start at the headings at which most groups agree.
Start find_start(const Adjustment& adjustment, double level);

struct Search {
  double level;               // significance of the tests of all groups together
  double variance = 1.0;      // ratio of actual to stated variance, for all observations
  std::vector<bool> among{};  // for each group, whether it may be kept; if empty, all may
};
using TellAdjusted = std::function<void()>;

bool is_finite(const Fit& fit);

// Data snooping. Each round accepts again the rejected group that passes its test best, or rejects
// the kept group that fails worst. The search ends when it reaches a set that was tried before.
// `tell` is called in each round.
Fit snoop(const Adjustment& adjustment, const Start& start, const Search& search,
          const TellAdjusted& tell = {});

}  // namespace ols::calibration
