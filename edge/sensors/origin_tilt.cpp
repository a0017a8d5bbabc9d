// From the inclinometer's two angles to the tilt of ORIGIN.
#include <algorithm>
#include <cmath>
#include <utility>

#include "edge/sensors/inclinometer.h"

namespace ols::sensors {

TiltReading origin_tilt(const InclinometerConfig& config, const AxisAngles& shown) {
  double x_rad = shown.x_rad;
  double y_rad = shown.y_rad;
  if (config.swap_axes) std::swap(x_rad, y_rad);
  x_rad = config.x_sign * (x_rad - config.x_zero_rad);
  y_rad = config.y_sign * (y_rad - config.y_zero_rad);
  // In ORIGIN, after RX(tilt_x) RY(tilt_y), up is (-sin ty cos tx, sin tx, cos ty cos tx): the Y
  // axis rises by tx, the X axis falls by asin(sin ty cos tx).
  const double sine = std::clamp(std::sin(y_rad) / std::cos(x_rad), -1.0, 1.0);
  return {shown.time_s, x_rad, std::asin(sine)};
}

}  // namespace ols::sensors
