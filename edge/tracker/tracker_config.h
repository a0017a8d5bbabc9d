// Parameters of the visual tracker with their defaults.
#pragma once

namespace ols {

struct TrackerConfig {
  int particles = 300;
  // Standard deviations of the motion model's noise, eq. (2)-(4), per second of frame interval
  // where the unit says so; pixels of the full frame.
  double position_sd_px = 2.0;
  double velocity_sd_px_s = 40.0;
  double size_sd_fraction = 0.01;  // of the box's width and height, per frame
};

}  // namespace ols
