#include "tools/calibrate/motion_leave.h"

#include "edge/station/station_mode.h"

namespace ols::calibration {
namespace {

using Status = ols_msg::station_status_t;

static_assert(kReliedOn_s < station::StationMode::kStopHold_s);

// A negative age: the clock was set, and nothing is known.
bool is_fresh(double age_s) { return age_s >= 0.0 && age_s < kReliedOn_s; }

}  // namespace

bool may_point(const Status& status, double age_s) {
  return is_fresh(age_s) && status.state != Status::STATE_STOPPED &&
         status.state != Status::STATE_EMERGENCY;
}

bool may_release(const Status& status, double age_s) {
  return is_fresh(age_s) && status.state == Status::STATE_MANUAL;
}

}  // namespace ols::calibration
