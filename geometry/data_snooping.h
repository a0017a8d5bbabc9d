// Data snooping: which of the sighted landmarks are mistaken, if that can be told.
//
// A landmark is mistaken when the others leave no doubt (Baarda's w-test with both components of
// all its sightings at once, the level shared by all landmarks). Its error takes no part in the
// supposition, so that a set of mistaken landmarks costs the misfit of the others plus a critical
// value for each one set aside. From the heading of each landmark, the set that it leads to is
// grown until no landmark inside fails its test and none outside would pass; the cheapest is taken.
// The same is tried supposing that all stated deviations are too small by 2, 4 or 8: what is evenly
// bad is not thrown away until a few remain that agree by chance. That is believed at odds of 1000,
// or of 20 where it cannot be told which landmarks are mistaken.
//
// No landmark is guessed to be wrong: as much must be kept as is set aside and more, no other
// landmarks must do as well in the place of those set aside (odds of 1000), and those must not
// agree with one another as half of the kept do: then the tripod was moved, or the survey has two
// origins.
#pragma once

#include "geometry/landmark_adjustment.h"

namespace ols {

// LandmarksContradict where it cannot be told.
LandmarkFit without_mistaken(const LandmarkAdjustment& adjustment, double level);

// Its test's chi-square, inside or outside: against the kept others.
double leave_one_out(const LandmarkFit& fit, std::size_t landmark);
double critical_value(const LandmarkAdjustment& adjustment, std::size_t landmark, double level);
// The minimal detectable bias [m] across and up; the noncentrality is that of the test's power.
Eigen::Vector2d detectable_m(const LandmarkAdjustment& adjustment, const LandmarkFit& fit,
                             std::size_t landmark, double noncentrality);

}  // namespace ols
