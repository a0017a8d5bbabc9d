// How white a station's noise is, from the second differences of its own bearings, in which the
// target's motion cancels. Pure.
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
  // Gives the errors the distance of a bearing from the line between its neighbours, and returns
  // the factor by which its variance counts more than stated.
  double observe(const BearingMeasurement& measurement, const RayFrame& frame, BiasModel& shown);

 private:
  // The two bearings before the next one.
  std::array<std::int64_t, 2> utime_us_{};
  std::array<Eigen::Vector3d, 2> direction_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

}  // namespace ols::fusion
