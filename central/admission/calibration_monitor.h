// Compares the calibration error that a station states with the bias that its residuals show. The
// station's own reference views are another, independent check. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>

#include "conditions/alarm.h"

namespace ols::fusion {

// The values are those of station_status_t.
enum class CalibrationState { kNone, kInUse, kRefused, kDoubted };

// A station's calibration, as the station states it.
struct StatedCalibration {
  CalibrationState state = CalibrationState::kNone;
  std::int64_t observed_utime_us = 0;  // time of the calibration's last observation; 0: not stated
  double sd_rad = std::numeric_limits<double>::quiet_NaN();  // 1-sigma of a direction, each axis
};

// The filter's estimate of a station's bias (cross-elevation, elevation), and the sigma that the
// station states; NaN where the bias is not observable.
struct FoundBias {
  Eigen::Vector2d bias_rad, stated_sd_rad;
};

// The alarm for a station that uses a calibration; empty if there is none. It is raised if the
// probability of such a bias, according to the stated sigma, is below 1 in 16 000.
Alarm calibration_alarm(const std::string& station, const StatedCalibration& stated,
                        const FoundBias& found);

}  // namespace ols::fusion
