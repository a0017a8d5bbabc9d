#include "calibration/guidance.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "calibration/adjustment.h"
#include "geometry/angles.h"
#include "geometry/pixel_prediction.h"

namespace ols::calibration {
VolumePrecision planned_precision(const Problem& plan, std::size_t station,
                                  const StationModel& model, const WorkingVolume& volume) {
  Problem at_model = plan;
  at_model.stations[station].model = model;
  const Adjustment adjustment(network_of(at_model));
  const StationMatrix C = adjustment.planned_covariance(station);
  return volume_precision(model, C, volume);
}

std::vector<Advice> rank_sightings(const Problem& so_far, std::size_t station,
                                   const StationModel& model,
                                   const std::vector<Candidate>& candidates,
                                   const WorkingVolume& volume) {
  std::vector<Advice> ranked;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Problem with = so_far;
    for (const Observation& one : candidates[i].sightings) with.observations.push_back(one);
    try {
      const VolumePrecision left = planned_precision(with, station, model, volume);
      if (std::isfinite(left.rms_rad)) ranked.push_back({i, left.rms_rad, left.worst_rad});
    } catch (const ObservationRefused&) {
      continue;  // too low, too far, outside of its trajectory
    }
  }
  std::ranges::stable_sort(ranked, {}, &Advice::rms_rad);
  return ranked;
}

std::optional<UnitReading> reading_towards(const StationModel& model, const HomogeneousPoint& point,
                                           const Eigen::Vector2d& pixel, int approach_pan,
                                           int approach_tilt) {
  const ChainParameters& chain = model.geometry.chain;
  const AzimuthElevation there = azimuth_elevation_from_enu(point.x);
  UnitReading reading;
  reading.pan.approach = approach_pan;
  reading.tilt.approach = approach_tilt;
  const double pan_counts_rad =
      chain.pan_sign * static_cast<double>(model.pan.counts_per_turn) / (2.0 * kPi);
  const double tilt_counts_rad =
      chain.tilt_sign * static_cast<double>(model.tilt.counts_per_turn) / (2.0 * kPi);
  reading.pan.counts =
      wrap_pi(chain.heading_rad - there.azimuth_rad - chain.pan_zero_rad) * pan_counts_rad;
  reading.tilt.counts = (there.elevation_rad - chain.tilt_zero_rad) * tilt_counts_rad;
  // Newton's steps on the two shafts: the mounting and the tilts are small turns.
  constexpr int kSteps = 12;
  constexpr double kThere_px = 1e-3;
  for (int i = 0; i < kSteps; ++i) {
    const auto image = predict_pixel(model, reading, point);
    if (!image || !image->pixel.allFinite()) return std::nullopt;
    const Eigen::Vector2d off = pixel - image->pixel;
    if (off.norm() < kThere_px) return reading;
    const Eigen::Vector2d turn = image->by_shafts.inverse() * off;
    if (!turn.allFinite()) return std::nullopt;
    reading.pan.counts += turn[0] * pan_counts_rad;
    reading.tilt.counts += turn[1] * tilt_counts_rad;
  }
  return std::nullopt;
}

}  // namespace ols::calibration
