// By how much an adjustment has changed a parameter from its prior.
#pragma once

#include "calibration/calibrate.h"

namespace ols::calibration {

struct ParameterChange {
  double by = 0.0;  // adjusted value minus prior
  // 1-sigma that `by` should have if prior and observations agree: the root of the decrease in
  // variance.
  double sd = 0.0;
  // Whether the observations determine the parameter: they reduce its variance by at least 5 %.
  bool is_told = false;
  double sigmas() const;
  // Whether prior and observations disagree: the change is significant at level 0.001.
  bool is_large() const;
};

ParameterChange parameter_change(const Network& network, const Fit& fit, std::size_t station,
                                 int parameter);

// The error of the clock that stamps the sightings of the sky, as all observations show it; the
// clock's stated error is not used as a prior. A wrong time turns the whole sky about the pole, and
// a leaning tripod has the same effect. Stars alone therefore cannot check the clock, but stars
// together with landmarks or an inclinometer can.
struct ClockCheck {
  double fast_s = 0.0;
  // 1-sigma that `fast_s` should have if the stated error is right; infinite if nothing checks the
  // clock.
  double sd_s = 0.0;
  double sigmas() const;
  bool is_large() const;        // level 0.001
  double detectable_s() const;  // the error that the test finds with a probability of 80 %
};
// `scaled_by`: Calibration::scaled_by.
ClockCheck clock_check(const Network& network, const Fit& fit, double scaled_by = 1.0);

}  // namespace ols::calibration
