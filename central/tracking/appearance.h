// Decides whether two bearings can belong to one object, by comparing rate, size and brightness. A
// quantity that one of the bearings does not state is not compared. Pure.
#pragma once

#include <Eigen/Core>

#include "central/filter/interacting_models.h"
#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

// Whether two bearings whose rays meet at these ranges can belong to one object. Three conditions
// must hold. The speeds perpendicular to the plane of both rays agree (`plane_normal`: the plane's
// unit normal, ECEF). To within their errors, the sizes are between 0.05 m and 80 m, and the larger
// is at most 4 times the smaller. The larger brightness (signal times range squared) is at most 30
// times the smaller.
bool may_be_same_object(const BearingMeasurement& a, double range_a_m, const BearingMeasurement& b,
                        double range_b_m, const Eigen::Vector3d& plane_normal);

// The squared normalised difference between the angular rates of a bearing and of a target (2
// degrees of freedom); 0 for a bearing without a rate.
double rate_nis(const BearingMeasurement& measurement, const KinematicState& target);

}  // namespace ols::fusion
