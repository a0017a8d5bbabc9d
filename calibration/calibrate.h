// A complete calibration: finds the initial headings, adjusts, and tests the observations by data
// snooping (W. Baarda, A Testing Procedure for Use in Geodetic Networks, 1968).
//
// The search starts from the headings on which most groups of observations agree. Each group is
// tested against all other groups; the test uses both components of all sightings of the group at
// once. Groups that fail are rejected one by one, the worst first. Rejected groups that pass later
// are accepted again. Scene points are not tested: those that do not fit get a smaller, robust
// weight.
#pragma once

#include <string>
#include <vector>

#include "calibration/snooping.h"

namespace ols::calibration {

struct Levels {
  double mistaken = 1e-3;  // level of significance of the tests of all groups together
  double misfit = 0.05;    // level of significance of the global test
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
  std::vector<std::string> remarks;  // sentences for a person: what should be checked
  // The covariance of one station's parameters. It includes the variance factor if the global test
  // fails.
  StationMatrix covariance(const Network& network, std::size_t station) const;
  double scaled_by = 1.0;  // factor by which the stated deviations were enlarged
  // False if only rectification targets or scenery were sighted, because these do not determine the
  // stations' headings. If false, only the parameters of the instruments are valid results.
  bool headings_known = true;
};

// Thrown if the observations contradict each other, and it is not clear which minority of them is
// mistaken.
class Contradiction : public std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

// The ratio of the actual to the stated scatter of the shared poses' angles. 1 unless the scatter
// is significantly larger than stated (level 0.01, at least ten redundant angles).
double pose_scatter(const Adjustment& adjustment, const Fit& fit);

// Throws Contradiction. Throws std::invalid_argument if the observations do not determine a
// station's heading. `tell` is called after each adjustment.
Calibration calibrate(const Adjustment& adjustment, const Levels& levels = {},
                      const TellAdjusted& tell = {});

}  // namespace ols::calibration
