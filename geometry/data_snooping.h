// Data snooping: finds the mistaken landmarks among the sighted ones.
//
// Each landmark is tested by Baarda's w-test, with both components of all its sightings at once.
// The landmarks share the level of significance. The cost of a hypothesis is the misfit of the kept
// landmarks plus one critical value for each rejected one. From the heading of each landmark, a set
// is grown until no landmark inside fails its test and none outside passes. The cheapest set wins.
//
// The search is repeated with all stated deviations enlarged by 2, 4 and 8. Otherwise uniformly bad
// sightings would be rejected until a few remain that agree by chance. The enlarged deviations are
// accepted at odds of 1000, or of 20 where the mistaken landmarks are ambiguous.
//
// Landmarks are rejected only if three conditions hold:
//  - More landmarks are kept than rejected.
//  - No other choice fits nearly as well (odds of 1000).
//  - The rejected landmarks do not agree with each other in a group half as large as the kept one.
//    Such a group means that the tripod was moved, or that the survey has two origins.
#pragma once

#include "geometry/landmark_adjustment.h"

namespace ols {

// Throws LandmarksContradict if the mistaken landmarks are ambiguous.
LandmarkFit without_mistaken(const LandmarkAdjustment& adjustment, double level);

// The chi-square of the landmark's test against the other kept landmarks.
double leave_one_out(const LandmarkFit& fit, std::size_t landmark);
double critical_value(const LandmarkAdjustment& adjustment, std::size_t landmark, double level);
// The minimal detectable bias [m] across and up, at the noncentrality of the test's power.
Eigen::Vector2d detectable_m(const LandmarkAdjustment& adjustment, const LandmarkFit& fit,
                             std::size_t landmark, double noncentrality);

}  // namespace ols
