// The fields of a GNSS receiver's reading that a station needs. Pure.
#pragma once

#include <Eigen/Core>

#include "geometry/wgs84.h"

namespace ols::sensors {

// Worst first. (gpsd: 3 is RTK fixed, 4 RTK float; NMEA's GGA: 4 is fixed, 5 float.)
enum class GnssFix { kNone, k2D, k3D, kDifferential, kRtkFloat, kRtkFixed };
const char* to_string(GnssFix fix);

struct GnssReading {
  double time_s = 0.0;  // station's monotonic clock: arrival
  GnssFix fix = GnssFix::kNone;
  // Of the antenna; only with k3D or better. Height above the ellipsoid.
  Geodetic antenna;
  Eigen::Vector3d sd_enu_m = Eigen::Vector3d::Zero();  // 1-sigma, stated by the receiver
  int satellites_used = 0;
};

}  // namespace ols::sensors
