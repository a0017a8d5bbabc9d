// The data of a GNSS receiver's reading that a station needs. Pure.
#pragma once

#include <Eigen/Core>

#include "geometry/wgs84.h"

namespace ols::sensors {

// In order of quality, worst first. (gpsd: 3 is RTK fixed, 4 RTK float; NMEA's GGA: 4 is fixed, 5
// float.)
enum class GnssFix { kNone, k2D, k3D, kDifferential, kRtkFloat, kRtkFixed };
const char* to_string(GnssFix fix);

struct GnssReading {
  double time_s = 0.0;  // arrival, on the station's monotonic clock
  GnssFix fix = GnssFix::kNone;
  // Position of the antenna; set only with k3D or better. The height is above the ellipsoid.
  Geodetic antenna;
  Eigen::Vector3d sd_enu_m = Eigen::Vector3d::Zero();  // 1-sigma as stated by the receiver
  int satellites_used = 0;
};

}  // namespace ols::sensors
