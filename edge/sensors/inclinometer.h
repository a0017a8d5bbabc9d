// The interface of all kinds of inclinometers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/config/config_section.h"
#include "edge/device/device_report.h"
#include "edge/sensors/tilt_reading.h"

namespace ols::sensors {

// An inclinometer with its own thread, which connects to the sensor. No function throws after
// construction.
class Inclinometer {
 public:
  virtual ~Inclinometer() = default;
  // Readings since the last call, oldest first.
  virtual std::vector<TiltReading> take_readings() = 0;
  virtual device::DeviceReport report() const = 0;
};

// The configuration that all kinds of inclinometers have in common.
struct InclinometerConfig {
  double stale_s = 3.0;  // after this time without a good reading, the sensor counts as faulty
  // The sensor counts as stuck if no digit of its readings has changed for this time.
  double stuck_s = 60.0;
  // The conversion from the sensor's axes to the axes of ORIGIN (the frame of the tripod's head):
  // first swap the axes, then subtract the zero, which is the reading while ORIGIN is level, then
  // apply the sign.
  int x_sign = 1, y_sign = 1;
  bool swap_axes = false;
  double x_zero_rad = 0.0, y_zero_rad = 0.0;
  double range_rad = 0.7;  // larger readings are rejected
  // 1-sigma of the errors of zero and mounting, which averaging does not reduce
  double sd_rad = 2e-4;
};

// The common rows of the section [inclinometer].
std::vector<config::Row> inclinometer_rows(InclinometerConfig& config);

// The angles of the sensor's own two axes, as it reports them.
struct AxisAngles {
  double time_s = 0.0;  // arrival of the reading, on the station's monotonic clock
  double x_rad = 0.0;
  double y_rad = 0.0;
};

// Computes the tilt of ORIGIN from the angles of the sensor's axes. Each axis of the sensor
// measures its own inclination to the horizontal. In the kinematic chain, however, tilt_y is
// applied after tilt_x. At 10 degrees of tilt_x, the measured inclination of Y is therefore 1.5 %
// smaller than tilt_y. Pure.
TiltReading origin_tilt(const InclinometerConfig& config, const AxisAngles& shown);

class InclinometerKind {
 public:
  virtual ~InclinometerKind() = default;
  virtual config::Section section() = 0;  // binds its keys to this object's members
  virtual const InclinometerConfig& config() const = 0;
  virtual bool is_configured() const = 0;   // false if the station has no inclinometer
  virtual std::string address() const = 0;  // description of where the sensor is, for messages
  virtual std::unique_ptr<Inclinometer> open() const = 0;
};

}  // namespace ols::sensors
