#include "edge/sensors/gnss_reading.h"

namespace ols::sensors {

const char* to_string(GnssFix fix) {
  switch (fix) {
    case GnssFix::kNone:
      return "no fix";
    case GnssFix::k2D:
      return "2D";
    case GnssFix::k3D:
      return "3D";
    case GnssFix::kDifferential:
      return "differential";
    case GnssFix::kRtkFloat:
      return "RTK float";
    case GnssFix::kRtkFixed:
      return "RTK fixed";
  }
  return "no fix";
}

}  // namespace ols::sensors
