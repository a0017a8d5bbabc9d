// A reading of the inclinometer. Pure.
#pragma once

namespace ols::sensors {

// The inclination of the tripod's head at ORIGIN, corrected for the sensor's mounting, with the
// signs of ChainParameters.
struct TiltReading {
  double time_s = 0.0;      // arrival, on the station's monotonic clock
  double tilt_x_rad = 0.0;  // about X; right side down > 0
  double tilt_y_rad = 0.0;  // about Y; nose down > 0
};

}  // namespace ols::sensors
