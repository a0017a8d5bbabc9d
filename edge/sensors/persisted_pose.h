// The pose that the sensors have measured, as it is saved for the next start, and its text in a
// file. Pure.
//
//   ols-pose 1
//   position LATITUDE_deg LONGITUDE_deg HEIGHT_m SD_EAST_m SD_NORTH_m SD_UP_m UTIME_us
//   tilt X_deg Y_deg SD_deg UTIME_us
//   sum HEX                               (FNV-1a, 64 bits, of everything before this line)
//
// The lines `position` and `tilt` may be missing.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "geometry/wgs84.h"

namespace ols::sensors {

struct PersistedPose {
  struct Position {
    Geodetic ground;
    Eigen::Vector3d sd_enu_m = Eigen::Vector3d::Zero();
    std::int64_t utime_us = 0;  // time of the measurement
  };
  struct Tilt {
    Eigen::Vector2d tilt_rad = Eigen::Vector2d::Zero();  // x, y
    double sd_rad = 0.0;
    std::int64_t utime_us = 0;
  };
  std::optional<Position> position;
  std::optional<Tilt> tilt;
};

std::string to_text(const PersistedPose& pose);

// Returns the pose in the text, or an error with the number of the line.
std::variant<PersistedPose, std::string> persisted_pose_from(std::string_view text);

}  // namespace ols::sensors
