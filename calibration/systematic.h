// The systematic error of a direction that remains after a calibration: its covariance J C J' in
// one direction, and its RMS and largest values over all directions in which a station works.
#pragma once

#include <optional>
#include <vector>

#include "calibration/parameters.h"
#include "geometry/pixel_prediction.h"

namespace ols::calibration {

struct SystematicDirection {
  AzimuthElevation direction;                                 // apparent: includes refraction
  Eigen::Matrix2d covariance_rad2 = Eigen::Matrix2d::Zero();  // (cross-elevation, elevation)
};

// nullopt if the pixel cannot be unprojected.
std::optional<SystematicDirection> systematic_direction(const StationModel& model,
                                                        const StationMatrix& covariance,
                                                        const UnitReading& reading,
                                                        const Eigen::Vector2d& pixel);

// The pan and tilt angles in which a station works.
struct WorkingVolume {
  double pan_deg = 150.0;  // to the left and to the right of pan 0
  double lowest_deg = -5.0, highest_deg = 30.0;
};

struct VolumePoint {
  double pan_deg = 0.0, tilt_deg = 0.0;
  double rms_rad = 0.0;  // per axis
};

struct VolumePrecision {
  double rms_rad = 0.0, worst_rad = 0.0;  // per axis
  std::vector<VolumePoint> points;
};

// Computed on a grid of directions, at the image centre, with alternating directions of approach.
VolumePrecision volume_precision(const StationModel& model, const StationMatrix& covariance,
                                 const WorkingVolume& volume = {});

}  // namespace ols::calibration
