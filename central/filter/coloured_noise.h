// Measures how white a station's noise is, from the second differences of its bearings. In these,
// the target's motion cancels. Pure.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "central/filter/bias_model.h"
#include "central/measurement/bearing_measurement.h"
#include "central/measurement/ray.h"

namespace ols::fusion {

class ColouredNoise {
 public:
  // Takes a bearing. Reports to `evidence` how far the middle one of the last three bearings is
  // from the line between its neighbours. Returns the factor by which to multiply the stated
  // variance of the new bearing.
  double observe(const BearingMeasurement& measurement, const RayFrame& frame, BiasModel& evidence);

 private:
  // The last two bearings.
  std::array<std::int64_t, 2> utime_us_{};
  std::array<Eigen::Vector3d, 2> direction_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

}  // namespace ols::fusion
