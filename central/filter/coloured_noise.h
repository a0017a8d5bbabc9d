// How white a station's noise is, from the second differences of its own bearings: the target's
// motion drops out of them. Pure.
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
  // Tells the errors how much a bearing differs from the line between its neighbours, and gives the
  // factor by which its variance counts more than stated.
  double observe(const BearingMeasurement& sighting, const RayFrame& frame, BiasModel& shown);

 private:
  // The two bearings before the next one.
  std::array<std::int64_t, 2> utime_us_{};
  std::array<Eigen::Vector3d, 2> direction_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

}  // namespace ols::fusion
