// A station's report on its calibration. Pure.
#pragma once

#include <cstdint>

namespace ols::station {

// The values are those of station_status_t.
enum class CalibrationState {
  kNone,     // no calibration: heading, mounting and sigmas are those of the configuration
  kInUse,    // the systematic part of the bearings' covariance comes from the calibration
  kRefused,  // configured, but not used; an alarm says why
  kDoubted,  // in use, but the reference views have moved; the sigmas include this
};

struct CalibrationStatus {
  CalibrationState state = CalibrationState::kNone;
  std::int64_t id = 0;
  std::int64_t observed_utime_us = 0;  // UTC of the calibration's last observation; 0 if not stated
  // 1-sigma of a direction, per axis, including the doubt; 0 if there is no calibration.
  double rms_rad = 0.0;
};

}  // namespace ols::station
