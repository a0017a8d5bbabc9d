// The change of a parameter from its prior by an adjustment.
#pragma once

#include "calibration/calibrate.h"

namespace ols::calibration {

struct ParameterChange {
  double by = 0.0;  // adjusted value minus prior
  // 1-sigma of `by` if prior and observations agree: the root of the decrease in variance.
  double sd = 0.0;
  // Whether the observations determine the parameter at all; false if they say almost nothing.
  bool is_told = false;
  double sigmas() const;
  // Whether the change is so large that prior and observations disagree (level 0.001).
  bool is_large() const;
};

ParameterChange parameter_change(const Network& network, const Fit& fit, std::size_t station,
                                 int parameter);

}  // namespace ols::calibration
