// A digital inclinometer (TE DPG2) on a serial line. A thread opens the device, and reopens it
// after a failure. report() states what is wrong. After construction nothing throws.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "edge/device/device_report.h"
#include "edge/sensors/dpg2.h"
#include "edge/sensors/tilt_reading.h"

namespace ols::config {
struct Section;
}
namespace ols::sensors {

struct InclinometerConfig {
  std::string device;  // serial device; empty: no inclinometer
  int baud = 9600;
  bool even_parity = false;  // BEI and AGS variants: 8E1
  double stale_s = 3.0;      // a fault after this time without a good reading
  double stuck_s = 60.0;     // stuck after this time without a change of any digit
  // From the sensor's axes to ORIGIN: the axes are swapped, then the zero (the reading when ORIGIN
  // is level) is subtracted, then the sign is applied.
  int x_sign = 1, y_sign = 1;
  bool swap_axes = false;
  double x_zero_rad = 0.0, y_zero_rad = 0.0;
  double range_rad = 0.7;  // a larger reading is rejected
  double sd_rad = 2e-4;    // 1-sigma of its zero and mounting; averaging does not reduce it
};

config::Section inclinometer_section(InclinometerConfig& config);  // [inclinometer]

// The tilt of ORIGIN from the angles of the sensor's axes. Each axis of the sensor shows its own
// inclination to the horizontal, while in the chain tilt_y is applied after tilt_x. At 10 degrees
// of tilt_x the difference is 1.5 % of tilt_y. Pure.
TiltReading origin_tilt(const InclinometerConfig& config, const AxisAngles& shown);

class Inclinometer {
 public:
  explicit Inclinometer(const InclinometerConfig& config);
  ~Inclinometer();
  Inclinometer(const Inclinometer&) = delete;
  Inclinometer& operator=(const Inclinometer&) = delete;

  // Readings since the last call, oldest first.
  std::vector<TiltReading> take_readings();
  device::DeviceReport report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sensors
