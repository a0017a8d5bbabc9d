// A whole calibration: the initial headings, the adjustment, and its tests by data snooping (W.
// Baarda, A Testing Procedure for Use in Geodetic Networks, 1968).
//
// Each group of observations is tested against all other groups, with both components of all its
// sightings at once. The search starts from the headings on which most groups agree. Groups that
// fail are rejected one by one, the worst first; rejected groups that pass later are accepted
// again. Scene points are not tested; a robust weight reduces those that do not fit.
#pragma once

#include <string>
#include <vector>

#include "calibration/snooping.h"

namespace ols::calibration {

struct Levels {
  double mistaken = 1e-3;  // significance of the tests of all groups together
  double misfit = 0.05;    // significance of the global test
};

// The global test (overall model test) of the groups that are not rejected.
struct ModelTest {
  double variance_factor = 1.0;
  double critical = 1.0;
  int redundancy = 0;
};

struct Calibration {
  Fit fit;
  std::vector<GroupTest> tests;  // for each group
  ModelTest global;
  // Measured minus adjusted [px], for each observation; nullopt for an unused observation.
  std::vector<std::optional<Eigen::Vector2d>> residuals;
  std::vector<std::string> remarks;  // sentences for a person to check
  // The covariance of one station's parameters. It includes the variance factor if the global test
  // fails.
  StationMatrix covariance(const Network& network, std::size_t station) const;
  double scaled_by = 1.0;  // factor by which the deviations were enlarged
  // False if only rectification targets or scenery were sighted, because these do not show where
  // the stations look. Then only the instruments' parameters are valid results.
  bool headings_known = true;
};

// Thrown if the observations contradict each other and no minority of them can be identified as the
// cause.
class Contradiction : public std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

// By which factor the angles of the shared poses scatter more than was stated; 1 if they do not.
// Tested at level 0.01, with at least ten redundant angles.
double pose_scatter(const Adjustment& adjustment, const Fit& fit);

// Throws Contradiction; throws std::invalid_argument if a heading stays unknown. `tell` is called
// after each adjustment.
Calibration calibrate(const Adjustment& adjustment, const Levels& levels = {},
                      const TellAdjusted& tell = {});

}  // namespace ols::calibration
