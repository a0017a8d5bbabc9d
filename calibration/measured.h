// A measured value with its uncertainty.
#pragma once

namespace ols::calibration {

struct Measured {
  double value = 0.0, sd = 0.0;  // 1-sigma
};

}  // namespace ols::calibration
