// Whether two bearings can be of one object, judged by rate, size and brightness. What a bearing
// does not state excludes nothing. Pure.
#pragma once

#include <Eigen/Core>

#include "central/filter/interacting_models.h"
#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

// Whether two bearings whose rays meet at these ranges can be of one object. The speeds at which
// they leave the plane of both rays must agree (`plane_normal`: its normal, ECEF, unit), the sizes
// within a factor of 4 and within 0.05 to 80 m, and the brightnesses (signal times range squared)
// within a factor of 30.
bool may_be_one(const BearingMeasurement& a, double range_a_m, const BearingMeasurement& b,
                double range_b_m, const Eigen::Vector3d& plane_normal);

// The squared normalised difference between the angular rates of a bearing and of a target (2
// degrees of freedom); 0 for a bearing without a rate.
double rate_nis(const BearingMeasurement& measurement, const KinematicState& target);

}  // namespace ols::fusion
