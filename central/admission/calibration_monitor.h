// What the stations say of their calibrations, and whether the residuals agree: the second witness
// beside a station's own reference views. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>

namespace ols::fusion {

enum class CalibrationState { kNone, kInUse, kRefused, kDoubted };

// As the station states it.
struct StatedCalibration {
  CalibrationState state = CalibrationState::kNone;
  std::int64_t observed_utime_us = 0;  // of its last observation; 0: not stated
  double sd_rad = std::numeric_limits<double>::quiet_NaN();  // of an axis of a direction
};

// The filter's estimate of a station's bias (cross-elevation, elevation) and what the station had
// stated of it; NaN where it is not observable.
struct FoundBias {
  Eigen::Vector2d bias_rad, stated_sd_rad;
};

// The finding about a station that works with a calibration, as text; empty: none. A bias that the
// station's own statement explains once in 16 000 times is more than its calibration.
std::string calibration_alarm(const std::string& station, const StatedCalibration& stated,
                              const FoundBias& found);

}  // namespace ols::fusion
