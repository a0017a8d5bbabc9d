// How far an adjustment has moved a parameter from what was known of it.
#pragma once

#include "calibration/calibrate.h"

namespace ols::calibration {

struct ParameterChange {
  double by = 0.0;  // found less known
  // Of `by`, if what was known and what was observed agree: the variance that the adjustment has
  // taken off.
  double sd = 0.0;
  // Else the observations say next to nothing of it.
  bool is_told = false;
  double sigmas() const;
  // More than agreement allows, once in a thousand.
  bool is_large() const;
};

ParameterChange parameter_change(const Network& network, const Fit& fit, std::size_t station,
                                 int parameter);

}  // namespace ols::calibration
