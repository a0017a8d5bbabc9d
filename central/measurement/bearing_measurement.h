// The fusion's input: one bearing from one station.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/direction.h"

namespace ols::fusion {

// Whether a station's clock is synchronised to UTC, as the station states it.
enum class StationClock { kUnknown, kSynchronised, kUnsynchronised };

// Other measurements of the object besides its direction. Zero or empty if unknown.
struct Sighted {
  // Angular rate on the tangent plane: cross-elevation, elevation.
  Eigen::Vector2d rate_rad_s = Eigen::Vector2d::Zero();
  // [rad^2/s^2] zero if the rate is unknown.
  Eigen::Matrix2d rate_covariance = Eigen::Matrix2d::Zero();
  double size_rad = 0.0, size_sd_rad = 0.0;  // largest extent
  double across_rad = 0.0;                   // smaller side of the object's upright box
  // The part of size_sd_rad that is independent from image to image; 0 if unknown.
  double size_noise_rad = 0.0;
  double signal = 0.0;                      // signal-to-noise ratio in one image
  std::vector<double> class_probability{};  // in the order of target_t's CLASS_*

  bool has_rate() const { return rate_covariance.trace() > 0.0; }
  bool has_appearance() const {
    return signal > 0.0 || size_rad > 0.0 || !class_probability.empty();
  }
};

struct BearingMeasurement {
  std::string station;
  std::int64_t utime_us = 0;  // UTC since 1970 at mid-exposure, according to the station's clock
  LineOfSight sight;
  double belief = 1.0;
  double clock_sd_s = 0.0;  // 1-sigma of utime_us, systematic
  StationClock clock = StationClock::kUnknown;
  // Boot id of the station's process. A new process starts new track_ids, and may use old numbers.
  std::int64_t boot_id = 0;
  std::int64_t track_id = 0;        // identifies one object that the station follows
  std::int64_t calibration_id = 0;  // a new id means new systematic errors
  bool is_tracklet = false;         // from a detector; nobody has designated the object
  // From a tracker that acquired the object where a slew pointed; nobody has designated the object.
  bool is_acquired = false;
  int image_bearings = 0;  // number of bearings that the station sends for this image; 0 if unknown
  Sighted sighted{};
};

}  // namespace ols::fusion
