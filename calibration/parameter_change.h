// How far an adjustment has moved a parameter from its prior.
#pragma once

#include "calibration/calibrate.h"

namespace ols::calibration {

struct ParameterChange {
  double by = 0.0;  // found minus known
  // 1-sigma of `by` if prior and observations agree: the root of the variance that the adjustment
  // has removed.
  double sd = 0.0;
  // False: the observations say almost nothing of the parameter.
  bool is_told = false;
  double sigmas() const;
  // More than agreement explains with a probability of one in a thousand.
  bool is_large() const;
};

ParameterChange parameter_change(const Network& network, const Fit& fit, std::size_t station,
                                 int parameter);

}  // namespace ols::calibration
