// A reading of a GNSS receiver. Pure.
#pragma once

#include <Eigen/Core>

#include "geometry/wgs84.h"

namespace ols::sensors {

// Kinds of fixes in order of quality, worst first. Their numbers differ elsewhere: in gpsd, 3 is
// RTK fixed and 4 is RTK float; in NMEA's GGA, 4 is RTK fixed and 5 is RTK float.
enum class GnssFix { kNone, k2D, k3D, kDifferential, kRtkFloat, kRtkFixed };
const char* to_string(GnssFix fix);

struct GnssReading {
  double time_s = 0.0;  // arrival of the reading, on the station's monotonic clock
  GnssFix fix = GnssFix::kNone;
  // Position of the antenna; complete only with k3D or better. The height is above the ellipsoid.
  Geodetic antenna;
  Eigen::Vector3d sd_enu_m = Eigen::Vector3d::Zero();  // 1-sigma as stated by the receiver
  int satellites_used = 0;
};

}  // namespace ols::sensors
