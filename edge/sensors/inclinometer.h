// A digital inclinometer (TE DPG2) on a serial line, opened and kept open by a thread of its own.
// Absent, late, garbled or gone: report() says so; after construction nothing throws.
#pragma once

#include <memory>
#include <vector>

#include "base/toml_config.h"
#include "edge/device_report.h"
#include "edge/sensors/tilt_reading.h"

namespace ols {

struct InclinometerConfig {
  std::string device;  // serial device; empty: the station has none
  int baud = 9600;
  bool even_parity = false;  // BEI and AGS variants: 8E1
  double stale_s = 3.0;      // no good reading for so long: a fault
  // Sensor to ORIGIN: which way the sensor's axes run, and what it shows when ORIGIN is level.
  int x_sign = 1, y_sign = 1;
  bool swap_axes = false;
  double x_zero_rad = 0.0, y_zero_rad = 0.0;
  double range_rad = 0.7;  // a reading beyond is refused
};

// `table` is [inclinometer]. Throws ConfigError.
InclinometerConfig read_inclinometer_config(ConfigTable& table);

class Inclinometer {
 public:
  explicit Inclinometer(const InclinometerConfig& config);
  ~Inclinometer();
  Inclinometer(const Inclinometer&) = delete;
  Inclinometer& operator=(const Inclinometer&) = delete;

  // Readings since the last call, oldest first.
  std::vector<TiltReading> take_readings();
  DeviceReport report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols
