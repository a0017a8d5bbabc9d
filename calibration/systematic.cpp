#include "calibration/systematic.h"

#include <algorithm>
#include <cmath>

namespace ols::calibration {

std::optional<SystematicDirection> systematic_direction(const StationModel& model,
                                                        const StationMatrix& covariance,
                                                        const UnitReading& reading,
                                                        const Eigen::Vector2d& pixel) {
  const auto seen = predict_direction(model, reading, pixel);
  if (!seen) return std::nullopt;
  const auto& J = seen->by_parameters;
  return SystematicDirection{
      seen->direction,
      J * covariance.topLeftCorner<kModelParameters, kModelParameters>() * J.transpose()};
}

VolumePrecision volume_precision(const StationModel& model, const StationMatrix& covariance,
                                 const WorkingVolume& volume) {
  constexpr int kPans = 24, kTilts = 7;
  const CameraIntrinsics& camera = model.geometry.camera;
  const Eigen::Vector2d middle((camera.width_px - 1) / 2.0, (camera.height_px - 1) / 2.0);
  VolumePrecision result;
  double squares = 0.0;
  for (int i = 0; i <= kPans; ++i) {
    for (int j = 0; j <= kTilts; ++j) {
      VolumePoint point;
      point.pan_deg = volume.pan_deg * (2.0 * i / kPans - 1.0);
      point.tilt_deg = volume.lowest_deg + (volume.highest_deg - volume.lowest_deg) * j / kTilts;
      UnitReading reading;
      reading.pan = {point.pan_deg / 360.0 * static_cast<double>(model.pan.counts_per_turn), 0.0,
                     i % 2 == 0 ? 1 : -1};
      reading.tilt = {point.tilt_deg / 360.0 * static_cast<double>(model.tilt.counts_per_turn), 0.0,
                      (i / 2 + j) % 2 == 0 ? 1 : -1};
      const auto seen = systematic_direction(model, covariance, reading, middle);
      if (!seen) continue;
      const double variance = 0.5 * seen->covariance_rad2.trace();
      point.rms_rad = std::sqrt(variance);
      squares += variance;
      result.points.push_back(point);
      result.worst_rad = std::max(result.worst_rad, point.rms_rad);
    }
  }
  if (!result.points.empty()) {
    result.rms_rad = std::sqrt(squares / static_cast<double>(result.points.size()));
  }
  return result;
}

}  // namespace ols::calibration
