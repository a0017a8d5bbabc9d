#include "edge/sensors/alarm_format.h"

#include <cstdio>

#include "geometry/angles.h"

namespace ols::sensors {

namespace {

std::string with_unit(const char* format, double number) {
  char text[64];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

}  // namespace

std::string format_length(double length_m) {
  if (length_m < 10.0) return with_unit("%.2f m", length_m);
  if (length_m < 10e3) return with_unit("%.0f m", length_m);
  return with_unit("%.0f km", length_m / 1e3);
}

std::string format_time(double time_s) {
  if (time_s < 120.0) return with_unit("%.0f s", time_s);
  if (time_s < 7200.0) return with_unit("%.0f min", time_s / 60.0);
  return with_unit("%.0f h", time_s / 3600.0);
}

std::string format_angle(double angle_rad) { return with_unit("%.2f deg", degrees(angle_rad)); }

}  // namespace ols::sensors
