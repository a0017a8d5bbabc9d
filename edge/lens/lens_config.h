// The configuration of a station's [lens_motor].
#pragma once

#include <string>
#include <vector>

#include "geometry/zoom_table.h"

namespace ols::config {
struct Section;
}
namespace ols::lens {

struct LensMotorConfig {
  std::string device;  // serial device; empty: no motorised lens
  int baud = 9600;
  double poll_interval_s = 0.05;
  double position_sd = 0.001;     // of a zoom position, slack included
  std::vector<ZoomPoint> points;  // of the calibration, ascending by position
};

config::Section lens_motor_section(LensMotorConfig& config);  // [lens_motor]

}  // namespace ols::lens
