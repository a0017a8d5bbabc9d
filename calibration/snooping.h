// Statistical tests of an adjustment's groups of observations, computed from its normal equations.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "calibration/adjustment.h"

namespace ols::calibration {

// The test statistic of a group: the decrease of the misfit when a kept group is left out, or the
// increase when a rejected group is added. If the group is right, the statistic is a chi-square
// with the group's degrees of freedom.
double test_statistic(const Adjustment& adjustment, const Fit& fit, std::size_t group);

// The same for a part of a block: the decrease of the misfit when the equations `now` are replaced
// by the equations `then`, over the same columns. Negative if the misfit increases.
double replacement_statistic(const Fit& fit, const BlockEquations& now, const BlockEquations& then);

// The smallest bias of the group's direction (across, up) that its test detects. `noncentrality`:
// that at which the test has the wanted power (least_noncentrality()).
Eigen::Vector2d detectable_rad(const Adjustment& adjustment, const Fit& fit, std::size_t group,
                               double noncentrality);

// The offset of a kept group's target from the position that all other groups predict, as seen from
// the station. bias_without() returns nullopt if no other group checks the target.
struct Bias {
  Eigen::Vector2d rad = Eigen::Vector2d::Zero();  // across, up
  double sigmas = 0.0;                            // of the larger component
};
std::optional<Bias> bias_without(const Adjustment& adjustment, const Fit& fit, std::size_t group);

// The critical value of a group's test. `level`: level of significance of all tests together; it is
// divided by the number of groups.
double critical_value(const Group& group, std::size_t groups, double level);

// The test of one group; all values are zero if the group is not tested.
struct GroupTest {
  bool rejected = false;
  double w = 0.0;  // root of the test statistic
  double critical = 0.0;
  // Minimal detectable bias (power 80 %) of the direction to the target: across, up. Infinite if
  // the other groups do not check the direction.
  Eigen::Vector2d detectable_rad = Eigen::Vector2d::Zero();
};

std::vector<GroupTest> tests_of(const Adjustment& adjustment, const Fit& fit, double level);

// Where the adjustment starts: the stations' headings, and the groups that agree with the priors at
// these headings.
struct Start {
  State state;
  std::vector<bool> kept;
};
// `variance`: the assumed ratio of actual to stated variance, the same for all observations.
Start start_at(const Adjustment& adjustment, const std::vector<double>& headings_rad, double level,
               double variance = 1.0);
// The start at the headings on which most groups agree.
Start find_start(const Adjustment& adjustment, double level);

struct Search {
  double level;               // level of significance of the tests of all groups together
  double variance = 1.0;      // assumed ratio of actual to stated variance
  std::vector<bool> among{};  // for each group, whether it may be kept; if empty, all may
};
using TellAdjusted = std::function<void()>;

bool is_finite(const Fit& fit);

// Data snooping. In each round, if any rejected groups pass their tests, the group that passes best
// is accepted again. Otherwise, the kept group that fails its test worst is rejected. The search
// ends if no group changes, or if the set of kept groups was tried before. `tell` is called in each
// round.
Fit snoop(const Adjustment& adjustment, const Start& start, const Search& search,
          const TellAdjusted& tell = {});

}  // namespace ols::calibration
