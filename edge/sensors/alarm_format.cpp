#include "edge/sensors/alarm_format.h"

#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::sensors {

namespace {}  // namespace

std::string format_length(double length_m) {
  if (length_m < 10.0) return printed("%.2f m", length_m);
  if (length_m < 10e3) return printed("%.0f m", length_m);
  return printed("%.0f km", length_m / 1e3);
}

std::string format_time(double time_s) {
  if (time_s < 120.0) return printed("%.0f s", time_s);
  if (time_s < 7200.0) return printed("%.0f min", time_s / 60.0);
  return printed("%.0f h", time_s / 3600.0);
}

std::string format_angle(double angle_rad) { return printed("%.2f deg", degrees(angle_rad)); }

}  // namespace ols::sensors
