#include "calibration/parameter_change.h"

#include <algorithm>
#include <cmath>

namespace ols::calibration {

double ParameterChange::sigmas() const { return std::abs(by) / sd; }

bool ParameterChange::is_large() const {
  constexpr double kCritical = 3.29;
  return is_told && sigmas() >= kCritical;
}

ParameterChange parameter_change(const Network& network, const Fit& fit, std::size_t station,
                                 int parameter) {
  constexpr double kTold = 0.05;  // of the variance that was known
  const int column = network.layout.station(station) + parameter;
  const double known = network.stations[station].covariance(parameter, parameter);
  const double taken_off = std::max(0.0, known - fit.covariance(column, column));
  return {fit.state.stations[station].change[parameter], std::sqrt(taken_off),
          taken_off > 0.0 && taken_off >= kTold * known};
}

}  // namespace ols::calibration
