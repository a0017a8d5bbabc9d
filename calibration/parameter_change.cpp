#include "calibration/parameter_change.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ols::calibration {
namespace {

constexpr double kCritical = 3.29;  // two-sided, level 0.001

}  // namespace

double ParameterChange::sigmas() const { return std::abs(by) / sd; }

bool ParameterChange::is_large() const { return is_told && sigmas() >= kCritical; }

ParameterChange parameter_change(const Network& network, const Fit& fit, std::size_t station,
                                 int parameter) {
  constexpr double kTold = 0.05;  // of the variance that was known
  const int column = network.layout.station(station) + parameter;
  const double known = network.stations[station].covariance(parameter, parameter);
  const double taken_off = std::max(0.0, known - fit.covariance(column, column));
  return {fit.state.stations[station].change[parameter], std::sqrt(taken_off),
          taken_off > 0.0 && taken_off >= kTold * known};
}

double ClockCheck::sigmas() const { return std::abs(fast_s) / sd_s; }

bool ClockCheck::is_large() const { return sigmas() >= kCritical; }

double ClockCheck::detectable_s() const {
  constexpr double kPower = 0.84;  // 80 %
  return (kCritical + kPower) * sd_s;
}

ClockCheck clock_check(const Network& network, const Fit& fit, double scaled_by) {
  const int column = network.layout.ut1();
  const double stated = network.ut1_sd_s * network.ut1_sd_s;
  const double all = 1.0 / fit.covariance(column, column), others = all - 1.0 / stated;
  constexpr double kNothing = 1e-9;  // of all the information
  if (others <= kNothing * all) return {0.0, std::numeric_limits<double>::infinity()};
  // UT1 follows the clock that is ahead backwards.
  return {-fit.state.ut1_s * all / others, std::sqrt(scaled_by * scaled_by / others + stated)};
}

}  // namespace ols::calibration
