// The configuration of a station's motorised lens.
#pragma once

#include <string>
#include <vector>

#include "geometry/zoom_table.h"

namespace ols::config {
struct Section;
}
namespace ols::lens {

struct LensMotorConfig {
  std::string device;  // serial device; empty if there is no motorised lens
  int baud = 9600;
  double poll_interval_s = 0.05;
  double position_sd = 0.001;     // 1-sigma of a zoom position, including mechanical slack
  std::vector<ZoomPoint> points;  // calibrated points of the zoom, in ascending order of position
};

config::Section lens_motor_section(LensMotorConfig& config);  // the section [lens_motor]

}  // namespace ols::lens
