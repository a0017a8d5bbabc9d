// Finds the mistaken landmarks of a stationing, by the tests of calibration/snooping.h.
//
// The cost of a hypothesis is the misfit of the kept landmarks, plus one critical value for each
// rejected landmark. A search starts at the heading of each landmark. The cheapest result of all
// searches wins.
//
// The search is repeated with all stated deviations enlarged by 2, 4 and 8. Without this, if all
// sightings were equally bad, most would be rejected until only a few remained that agree by
// chance. The result with enlarged deviations is accepted at odds of 1000, or at odds of 20 if the
// mistaken landmarks are ambiguous.
//
// Landmarks are rejected only if three conditions hold:
//  - More landmarks are kept than rejected.
//  - No other choice fits nearly as well (odds of 1000).
//  - The rejected landmarks contain no group that agrees with itself and is at least half as
//    large as the group of kept landmarks. Such a group means that the tripod was moved, or that
//    the survey has two origins.
#pragma once

#include "calibration/adjustment.h"

namespace ols::calibration {

// The redundancy: observations of the kept landmarks and the priors, minus unknowns. The heading
// has no prior.
int stationing_redundancy(const Adjustment& adjustment, const std::vector<bool>& kept);

// `adjustment`: of one station, with one group for each landmark. Throws LandmarksContradict if the
// mistaken landmarks are ambiguous.
Fit without_mistaken(const Adjustment& adjustment, double level);

}  // namespace ols::calibration
