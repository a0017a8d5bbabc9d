#include "edge/sensors/pose_estimator_config.h"

namespace ols::sensors {

void set_sensors(PoseEstimator::Config& c, const InclinometerConfig& inclinometer,
                 const GnssConfig& gnss) {
  c.ground_to_antenna_enu_m = gnss.ground_to_antenna_enu_m;
  c.least_fix = gnss.least_fix;
  c.gnss_sd_floor_m = gnss.sd_floor_m;
  c.gnss_stale_s = gnss.stale_s;
  c.accept_move_s = gnss.accept_move_s;
  c.inclinometer_sd_rad = inclinometer.sd_rad;
  c.inclinometer_stale_s = inclinometer.stale_s;
  c.stuck_s = inclinometer.stuck_s;
}

}  // namespace ols::sensors
