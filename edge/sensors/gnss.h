// A GNSS receiver through gpsd (libgps). A thread connects to gpsd, and reconnects after a loss.
// After construction nothing throws.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "edge/device/device_report.h"
#include "edge/sensors/gnss_reading.h"

namespace ols::config {
struct Section;
}
namespace ols::sensors {

struct GnssConfig {
  std::string host;  // of gpsd; empty: the station has no receiver
  bool has_receiver() const { return !host.empty(); }
  std::string port = "2947";
  double stale_s = 5.0;              // a fault after this time without a report
  GnssFix least_fix = GnssFix::k3D;  // min fix for the position
  Eigen::Vector3d ground_to_antenna_enu_m = Eigen::Vector3d::Zero();
  double sd_floor_m = 0.01;    // a smaller stated 1-sigma is raised to this
  double error_sigmas = 1.0;   // number of sigmas in gpsd's own errors; used without GST
  double accept_move_s = 0.0;  // a new position is adopted after holding this long; 0: never
};

config::Section gnss_section(GnssConfig& config);  // [gnss]

class Gnss {
 public:
  explicit Gnss(const GnssConfig& config);
  ~Gnss();
  Gnss(const Gnss&) = delete;
  Gnss& operator=(const Gnss&) = delete;

  std::vector<GnssReading> take_readings();  // since the last call, oldest first
  device::DeviceReport report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sensors
