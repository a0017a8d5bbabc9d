// The motorised lens on its serial line. A thread opens the port, and reopens it after a failure.
// report() states what is wrong. After construction nothing throws.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edge/device/device_report.h"
#include "edge/lens/lens_types.h"
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

class LensMotor {
 public:
  explicit LensMotor(const LensMotorConfig& config);
  ~LensMotor();
  LensMotor(const LensMotor&) = delete;
  LensMotor& operator=(const LensMotor&) = delete;

  // From any thread; does not wait.
  void order(const LensOrder& order);
  // Samples since the last call, oldest first.
  std::vector<ZoomSample> take_samples();
  ByAxis<std::optional<double>> positions() const;
  device::DeviceReport report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::lens
