// Writes the sentences (NMEA 0183 4.10) that a multi-system receiver sends for one epoch. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "geometry/wgs84.h"

namespace ols::sim {

struct NmeaEpoch {
  std::int64_t utime_us = 0;
  bool has_fix = true;  // false: no position in any sentence
  int quality = 4;      // of GGA. 1: autonomous, 2: differential, 4: RTK fixed, 5: RTK float
  Geodetic antenna;
  double geoid_m = 44.0;                           // height of the geoid above the ellipsoid
  Eigen::Vector3d sd_enu_m{0.01, 0.01, 0.015};     // 1-sigma that the receiver states
  int gps_satellites = 8, glonass_satellites = 6;  // in view and used; at most 12 of each
};

// "$" text "*" checksum CR LF.
std::string nmea_sentence(const std::string& text);

// RMC, GGA, GSA, GSV, GST.
std::string nmea_epoch(const NmeaEpoch& epoch);

}  // namespace ols::sim
