// Finds the mistaken landmarks of a stationing, by the tests of calibration/snooping.h.
//
// The cost of a hypothesis is the misfit of the kept landmarks, plus one critical value for each
// rejected landmark. For each landmark, a search starts at the heading that this landmark alone
// gives. Landmarks that an earlier search has kept are skipped. The result with the lowest cost
// wins.
//
// If all sightings are worse than stated by the same factor, this search would reject most
// landmarks, until only a few remained that agree by chance. If a landmark is rejected, the search
// is therefore repeated with all stated deviations enlarged by 2, 4 and 8. The result with enlarged
// deviations is preferred if the odds in its favour are above 1000; or above 20 if, without the
// enlargement, it is ambiguous which landmarks are mistaken.
//
// Landmarks are rejected only if three conditions hold:
//  - More landmarks are kept than rejected.
//  - Exchanging a rejected landmark for a kept one makes the fit worse, by odds of at least 1000.
//  - Among the rejected landmarks, no group agrees with itself and is at least half as large as the
//    group of kept landmarks. Such a group would mean that the tripod was moved, or that the survey
//    has two origins.
#pragma once

#include "calibration/adjustment.h"

namespace ols::calibration {

// The redundancy: the number of observations of the kept landmarks and of priors, minus the number
// of unknowns. The heading has no prior.
int stationing_redundancy(const Adjustment& adjustment, const std::vector<bool>& kept);

// The fit without the mistaken landmarks. `adjustment`: of one station, with one group for each
// landmark. Throws LandmarksContradict if it is ambiguous which landmarks are mistaken.
Fit without_mistaken(const Adjustment& adjustment, double level);

}  // namespace ols::calibration
