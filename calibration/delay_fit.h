// Finds by how much the times of a station's bearings are late, from an object that other stations
// see as well. Pure.
//
// At each whole second, the lines of all stations meet at the object. A station with late times
// sees the object where it was before: its line misses the others in proportion to the object's
// speed. The errors of the stations' orientations, positions and clocks are estimated with the
// delay, within what is known of them. The positions of the object are free.
//
// One other station is enough if the object also moves across the plane through both stations and
// the object. A delay shows best if the object moves fast and to and fro: a motion in one direction
// looks like an error of the heading.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "calibration/measured.h"

namespace ols::calibration {

// Positions and directions are in one east-north-up frame, the same for all stations.
struct TimedBearing {
  std::size_t station = 0;
  std::int64_t boot_id = 0, track_id = 0;  // one object of this station
  double time_s = 0.0;                     // UTC, as stamped
  Eigen::Vector3d camera_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  double sd_rad = 0.0;  // 1-sigma of each axis, independent in each bearing
};

// 1-sigma of a station's errors that are the same in all its bearings.
struct LastingErrors {
  double clock_sd_s = 0.0;
  double heading_sd_rad = 0.0, tilt_sd_rad = 0.0;
  double position_sd_m = 0.0;  // of each axis
};

struct DelayFit {
  // By how much the station's times are late; negative: they are early. nullopt if there are too
  // few seconds, if the fit did not settle, or if its 1-sigma would exceed 0.1 s.
  std::optional<Measured> late_s;
  std::size_t seconds = 0;  // at which the station and another one saw the object
  std::size_t several = 0;  // seconds left out, because a station saw several objects
  // RMS distance of the lines, divided by the value that `sd_rad` lets expect. If it is more than
  // 1, the uncertainty of late_s is larger by this factor.
  double misfit = 0.0;
};

// `stations`: one for each station. `wanted`: the station whose times are examined. Its delay is
// expected to be 0 +- 3 s, whatever its clock_sd_s. All stations must see the same object. Time and
// memory do not grow with gaps between bearings, nor with stations that have no bearings within
// 10 s of those of `wanted`.
DelayFit fit_delay(std::vector<TimedBearing> bearings, const std::vector<LastingErrors>& stations,
                   std::size_t wanted);

}  // namespace ols::calibration
