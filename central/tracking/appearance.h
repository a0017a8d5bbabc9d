// Whether what stations have seen of objects allows that they are one. What is unknown allows
// everything. Pure.
#pragma once

#include <Eigen/Core>

#include "central/filter/interacting_models.h"
#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

// Two bearings whose rays meet at these ranges, across `plane_normal` (ECEF, unit; of the plane of
// both rays): the object leaves that plane at one speed, is of one size within a factor of 4 and
// 0.05 to 80 m large, and of one brightness (signal times range squared) within a factor of 30.
bool may_be_one(const BearingMeasurement& a, double range_a_m, const BearingMeasurement& b,
                double range_b_m, const Eigen::Vector3d& plane_normal);

// The squared normalised difference of the angular rate of a bearing and of a target (2 degrees of
// freedom); 0 for a bearing without a rate.
double rate_nis(const BearingMeasurement& measurement, const KinematicState& target);

}  // namespace ols::fusion
