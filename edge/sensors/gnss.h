// A GNSS receiver through gpsd (libgps), connected and kept connected by a thread of its own.
// After construction nothing throws.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "edge/device_report.h"
#include "edge/sensors/gnss_reading.h"

namespace ols::config {
struct Section;
}
namespace ols {

struct GnssConfig {
  std::string host;  // of gpsd; empty: the station has no receiver
  std::string port = "2947";
  double stale_s = 5.0;              // no report for so long: a fault
  GnssFix least_fix = GnssFix::k3D;  // a worse one is not used for the position
  Eigen::Vector3d ground_to_antenna_enu_m = Eigen::Vector3d::Zero();
  double sd_floor_m = 0.01;    // no stated 1-sigma is believed to be smaller
  double error_sigmas = 1.0;   // gpsd's own errors are so many sigmas; only where there is no GST
  double accept_move_s = 0.0;  // a new position that holds for so long is taken; 0: never
};

config::Section gnss_section(GnssConfig& config);  // [gnss]

class Gnss {
 public:
  explicit Gnss(const GnssConfig& config);
  ~Gnss();
  Gnss(const Gnss&) = delete;
  Gnss& operator=(const Gnss&) = delete;

  std::vector<GnssReading> take_readings();  // since the last call, oldest first
  DeviceReport report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols
