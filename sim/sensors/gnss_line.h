// A GNSS receiver on a pseudo terminal in real time, sending NMEA for gpsd.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "geometry/wgs84.h"
#include "sim/scenario/faults.h"

namespace ols::sim {

struct GnssLineConfig {
  Geodetic antenna;       // true position
  double geoid_m = 44.0;  // height of the geoid above the ellipsoid there
  // 1-sigma of the error, which wanders within a minute like multipath. The receiver states it
  // correctly.
  double sd_horizontal_m = 0.01;  // of each of east and north
  double sd_up_m = 0.015;
  int quality = 4;  // of GGA: RTK fixed
  double rate_hz = 2.0;
};

class GnssLine {
 public:
  // `utime_us`: true UTC now; called by the line's thread. `link`: as for Pty. Throws
  // std::system_error.
  GnssLine(const GnssLineConfig& config, std::function<std::int64_t()> utime_us, std::uint64_t seed,
           const std::string& link = "");
  ~GnssLine();
  GnssLine(const GnssLine&) = delete;
  GnssLine& operator=(const GnssLine&) = delete;

  const std::string& device() const;  // the pty's slave

  void set_faults(const GnssFaults& faults);  // from any thread

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
