// What a station needs from an inclinometer of any kind: its readings and its state.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/config/config_section.h"
#include "edge/device/device_report.h"
#include "edge/sensors/tilt_reading.h"

namespace ols::sensors {

// Each kind searches for its sensor in its own thread. Nothing throws after construction.
class Inclinometer {
 public:
  virtual ~Inclinometer() = default;
  virtual std::vector<TiltReading> take_readings() = 0;  // those since the last call, oldest first
  virtual device::DeviceReport report() const = 0;
};

// The configuration that all kinds have in common.
struct InclinometerConfig {
  double stale_s = 3.0;  // after this time without a good reading, the sensor counts as faulty
  // After this time without a change of any digit, the sensor counts as stuck.
  double stuck_s = 60.0;
  // Conversion from the sensor's axes to ORIGIN, in this order: swap the axes, subtract the zero
  // (the reading when ORIGIN is level), apply the sign.
  int x_sign = 1, y_sign = 1;
  bool swap_axes = false;
  double x_zero_rad = 0.0, y_zero_rad = 0.0;
  double range_rad = 0.7;  // a larger reading is rejected
  double sd_rad = 2e-4;  // 1-sigma of the sensor's zero and mounting; averaging does not reduce it
};

// Rows of the section [inclinometer].
std::vector<config::Row> inclinometer_rows(InclinometerConfig& config);

// The angles that the sensor reports for its own two axes.
struct AxisAngles {
  double time_s = 0.0;  // arrival, on the monotonic clock
  double x_rad = 0.0;
  double y_rad = 0.0;
};

// Computes the tilt of ORIGIN from the angles of the sensor's axes. Each axis of the sensor shows
// its own inclination relative to the horizontal, but in the chain tilt_y is applied after tilt_x.
// At 10 degrees of tilt_x this makes a difference of 1.5 % of tilt_y. Pure.
TiltReading origin_tilt(const InclinometerConfig& config, const AxisAngles& shown);

class InclinometerKind {
 public:
  virtual ~InclinometerKind() = default;
  virtual config::Section section() = 0;  // the section refers to this object
  virtual const InclinometerConfig& config() const = 0;
  virtual bool is_configured() const = 0;   // false if the station has no inclinometer
  virtual std::string address() const = 0;  // where the station searches for it, in words
  virtual std::unique_ptr<Inclinometer> open() const = 0;
};

}  // namespace ols::sensors
