// A GNSS receiver on a pseudo terminal in real time, sending NMEA for gpsd.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <mutex>
#include <random>
#include <stop_token>
#include <string>
#include <thread>

#include "geometry/wgs84.h"
#include "sim/scenario/faults.h"
#include "sim/serial/pty.h"

namespace ols::sim {

struct GnssLineConfig {
  Geodetic antenna;       // true position
  double geoid_m = 44.0;  // height of the geoid above the ellipsoid there
  // 1-sigma of the error. Like multipath, the error changes within about a minute. The receiver
  // states this sigma.
  double sd_horizontal_m = 0.01;  // in each of east and north
  double sd_up_m = 0.015;
  int quality = 4;  // of the GGA sentence; 4: RTK fixed
  double rate_hz = 2.0;
};

class GnssLine {
 public:
  // `utime_us`: returns true UTC now; the line's thread calls it. `link`: as for Pty. Throws
  // std::system_error.
  GnssLine(const GnssLineConfig& config, std::function<std::int64_t()> utime_us, std::uint64_t seed,
           const std::string& link = "");

  const std::string& device() const { return pty_.device(); }

  void set_faults(const GnssFaults& faults);  // from any thread

 private:
  void run(const std::stop_token& stop);
  void send_epoch();
  void wander();  // advances the error, a first-order Gauss-Markov process
  std::string spoilt(const std::string& sentences, double share);
  Eigen::Vector3d normals();
  GnssFaults current_faults();

  const GnssLineConfig config_;
  const std::function<std::int64_t()> utime_us_;
  const LocalFrame frame_;
  const Eigen::Vector3d sd_enu_m_;
  std::mutex mutex_;  // for faults
  GnssFaults faults_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Eigen::Vector3d error_enu_m_;
  Pty pty_;
  std::jthread thread_;  // last: it uses the rest
};

}  // namespace ols::sim
