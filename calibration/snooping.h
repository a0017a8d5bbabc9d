// The tests of an adjustment's groups, from its equations.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "calibration/adjustment.h"

namespace ols::calibration {

// By how much the misfit falls when a kept group is left out, or grows when a rejected one is
// added: chi-square with the group's degrees of freedom.
double test_statistic(const Adjustment& adjustment, const Fit& fit, std::size_t group);

// The same for a part of a block: by how much the misfit falls when its equations `now` are
// replaced by `then`, over the same columns. Negative if it grows.
double replacement_statistic(const Fit& fit, const BlockEquations& now, const BlockEquations& then);

// The bias of the direction (across, up) that the group's test detects at this noncentrality.
Eigen::Vector2d detectable_rad(const Adjustment& adjustment, const Fit& fit, std::size_t group,
                               double noncentrality);

// The offset of a kept group's target from where all others put it, as seen from the station: the
// group is predicted without itself. nullopt if no other group checks it.
struct Bias {
  Eigen::Vector2d rad = Eigen::Vector2d::Zero();  // across, up
  double sigmas = 0.0;                            // of the worse component
};
std::optional<Bias> bias_without(const Adjustment& adjustment, const Fit& fit, std::size_t group);

// The headings on which most groups agree with the priors, and these groups.
struct Start {
  State state;
  std::vector<bool> kept;
};
Start find_start(const Adjustment& adjustment, double level);

// The critical value of a group's test.
double critical_value(const Group& group, std::size_t groups, double level);

}  // namespace ols::calibration
