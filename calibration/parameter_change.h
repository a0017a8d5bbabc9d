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

// The error of the clock that stamps the sightings of the sky, as all observations show it without
// the clock's own stated error. A wrong time turns the whole sky about the pole, and a tripod that
// leans the other way would see the same. So stars alone cannot check the clock, but landmarks and
// an inclinometer can.
struct ClockCheck {
  double fast_s = 0.0;
  // 1-sigma of `fast_s` if the stated error is right; infinite: nothing checks the clock.
  double sd_s = 0.0;
  double sigmas() const;
  bool is_large() const;        // level 0.001
  double detectable_s() const;  // the error that would be found with a power of 80 %
};
// `scaled_by`: factor by which the deviations of the observations were enlarged (Calibration).
ClockCheck clock_check(const Network& network, const Fit& fit, double scaled_by = 1.0);

}  // namespace ols::calibration
