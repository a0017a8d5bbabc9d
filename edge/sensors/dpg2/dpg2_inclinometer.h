// A digital inclinometer (TE DPG2) on a serial line. A thread opens the device and reopens it after
// a failure.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "edge/sensors/inclinometer.h"

namespace ols::sensors {

struct Dpg2Config : InclinometerConfig {
  std::string device;  // serial device; empty if there is no inclinometer
  int baud = 9600;
  bool even_parity = false;  // true for the variants BEI and AGS, which use 8E1
};

class Dpg2Inclinometer : public Inclinometer {
 public:
  explicit Dpg2Inclinometer(const Dpg2Config& config);
  ~Dpg2Inclinometer() override;
  Dpg2Inclinometer(const Dpg2Inclinometer&) = delete;
  Dpg2Inclinometer& operator=(const Dpg2Inclinometer&) = delete;

  std::vector<TiltReading> take_readings() override;
  device::DeviceReport report() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sensors
