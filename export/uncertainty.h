// Converts a covariance to the few numbers that most formats have. Pure.
#pragma once

#include "export/records.h"

namespace ols::exports {

struct Ellipse {
  double semi_major_m = kUnknown, semi_minor_m = kUnknown;  // 1-sigma
  double azimuth_deg = 0.0;  // of the major axis, clockwise from north, 0..180
};
// The ellipse of the horizontal part; all values are unknown if that part is not a valid
// covariance.
Ellipse ellipse_of(const Covariance& enu);
// 1-sigma of one axis; unknown if the variance is negative or not finite.
double sd(double variance);

// A standard deviation, rounded up to this many decimals, so that a text does not claim more
// accuracy than there is.
double rounded_up(double value, int decimals);

// Horizontal speed, course (clockwise from north) and climb rate of a target; unknown if the
// velocity is unknown.
struct Motion {
  double speed_m_s = kUnknown, course_deg = kUnknown, climb_m_s = kUnknown;
};
Motion motion_of(const Target& target);

}  // namespace ols::exports
