#include "edge/station/bearing_queue.h"

#include <cmath>
#include <utility>

#include "geometry/direction.h"

namespace ols::station {
namespace {

// Derivative of the direction, on its tangent plane, by the pixel [rad/px].
std::optional<Eigen::Matrix2d> radians_of_pixels(const PixelSight& pixel, const LineOfSight& line,
                                                 const UnitAngles& angles,
                                                 const PointingModel& pointing) {
  const auto tangent = tangent_basis(line.direction);
  Eigen::Matrix2d J;
  for (int axis = 0; axis < 2; ++axis) {
    PixelSight beside = pixel;
    beside.pixel(axis) += 1.0;
    const auto there = pointing.sight(beside, angles);
    if (!there) return std::nullopt;
    J.col(axis) = tangent.transpose() * enu_from_azimuth_elevation(there->direction);
  }
  return J;
}

DetectedObject object_of(const DetectedPixel& seen, const Eigen::Matrix2d& J) {
  const double scale = std::sqrt(std::abs(J.determinant()));
  DetectedObject object;
  object.is_tracklet = seen.is_tracklet;
  object.image_bearings = seen.image_bearings;
  object.rate_rad_s = J * seen.velocity_px_s;
  object.rate_covariance = std::pow(seen.velocity_sd_px_s, 2) * J * J.transpose();
  object.size_rad = scale * seen.size_px;
  object.size_sd_rad = scale * seen.size_sd_px;
  object.across_rad = scale * seen.across_px;
  object.size_noise_rad = scale * seen.size_noise_px;
  object.signal = seen.signal;
  return object;
}

}  // namespace

// Bearings are taken in any order: a detector's image is older than the tracker's newest frame, and
// need not wait for that frame's angles.
std::vector<MadeBearing> BearingQueue::take(const PointingModel& pointing, double now_s) {
  std::vector<MadeBearing> bearings;
  std::erase_if(waiting_, [&](const PixelMeasurement& measured) {
    const auto angles = pointing.angles_at(measured.mid_exposure_s, measured.stamp_sd_s);
    const bool bracketed = angles && angles->interpolated;
    if (!bracketed && now_s - measured.arrived_s < angle_wait_s_) return false;
    if (auto made = make(measured, pointing)) {
      made->to_send = worth_sending(made->bearing, pointing, now_s);
      bearings.push_back(std::move(*made));
    }
    return true;
  });
  return bearings;
}

std::optional<MadeBearing> BearingQueue::make(const PixelMeasurement& measured,
                                              const PointingModel& pointing) {
  const auto angles = pointing.angles_at(measured.mid_exposure_s, measured.stamp_sd_s);
  if (!angles) {
    counters_["frames_without_angles"] += 1;
    return std::nullopt;
  }
  PixelSight pixel;
  pixel.pixel = measured.pixel;
  pixel.covariance_px2 = measured.covariance_px2;
  pixel.aim_sd_px = measured.designation_sd_px;
  pixel.angles_covariance_rad2 = angles->covariance;
  pixel.angles_systematic_rad2 = angles->lasting_covariance;
  const auto line = pointing.sight(pixel, *angles);
  if (!line) {
    counters_["pixels_outside_lens_model"] += 1;
    return std::nullopt;
  }
  Bearing bearing{measured.mid_exposure_s, *line,
                  measured.belief,         measured.track_id,
                  measured.stamp_sd_s,     measured.stamp_source};
  bearing.pose_revision = pointing.pose_revision();
  bearing.sight.origin_sd_enu_m = pointing.pose().position_sd_enu_m;
  bearing.pixel = measured.pixel;
  bearing.covariance_px2 = measured.covariance_px2;
  bearing.designation_sd_px = measured.designation_sd_px;
  bearing.acquired = measured.acquired;
  if (measured.detected) {
    const auto J = radians_of_pixels(pixel, *line, *angles, pointing);
    bearing.detected = object_of(*measured.detected, J.value_or(Eigen::Matrix2d::Zero()));
  }
  return MadeBearing{bearing, angles->reported};
}

bool BearingQueue::worth_sending(const Bearing& bearing, const PointingModel& pointing,
                                 double now_s) {
  if (pointing.pose().position_source == sensors::PoseSource::kNone) {
    counters_["bearings_without_pose"] += 1;
    return false;
  }
  if (now_s - bearing.mid_exposure_s > max_age_s_) {
    counters_["bearings_too_old"] += 1;
    return false;
  }
  if (bearing.is_tracklet()) {
    counters_["tracklet_bearings"] += 1;
    return true;
  }
  counters_["bearings"] += 1;
  constexpr double kSmoothing = 0.1;
  frame_latency_s_ += kSmoothing * (now_s - bearing.mid_exposure_s - frame_latency_s_);
  return true;
}

}  // namespace ols::station
