// A reading of an inclinometer. Pure.
#pragma once

namespace ols::sensors {

// The inclination of the tripod's head (frame ORIGIN), corrected for the sensor's mounting. The
// signs are those of ChainParameters.
struct TiltReading {
  double time_s = 0.0;      // arrival of the reading, on the station's monotonic clock
  double tilt_x_rad = 0.0;  // about X; right side down > 0
  double tilt_y_rad = 0.0;  // about Y; nose down > 0
};

}  // namespace ols::sensors
