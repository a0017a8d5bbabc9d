#include "edge/station/bearing_queue.h"

#include <cmath>

namespace ols::station {

std::vector<MadeBearing> BearingQueue::take(const PointingModel& pointing, double now_s) {
  std::vector<MadeBearing> bearings;
  while (!waiting_.empty()) {
    const PixelMeasurement& measured = waiting_.front();
    const auto angles = pointing.angles_at(measured.mid_exposure_s);
    const bool bracketed = angles && angles->interpolated;
    if (!bracketed && now_s - measured.arrived_s < angle_wait_s_) break;
    if (auto made = make(measured, pointing)) {
      made->to_send = worth_sending(made->bearing, pointing, now_s);
      bearings.push_back(*made);
    }
    waiting_.pop_front();
  }
  return bearings;
}

std::optional<MadeBearing> BearingQueue::make(const PixelMeasurement& measured,
                                              const PointingModel& pointing) {
  const auto angles = pointing.angles_at(measured.mid_exposure_s);
  if (!angles) {
    counters_["frames_without_angles"] += 1;
    return std::nullopt;
  }
  PixelSight pixel;
  pixel.pixel = measured.output.pixel;
  pixel.covariance_px2 = measured.output.covariance_px2;
  const double sd = measured.designation_sd_px;
  pixel.covariance_systematic_px2 = Eigen::Matrix2d::Identity() * (sd * sd);
  // The frame's own stamp adds to the time jitter of the angles.
  const Eigen::Vector2d rate(angles->rate.pan_rad, angles->rate.tilt_rad);
  pixel.angles_covariance_rad2 =
      angles->covariance + rate * rate.transpose() * std::pow(measured.stamp_sd_s, 2);
  const auto line = pointing.sight(pixel, *angles);
  if (!line) {
    counters_["pixels_outside_lens_model"] += 1;
    return std::nullopt;
  }
  Bearing bearing{measured.mid_exposure_s, *line,
                  measured.output.belief,  measured.track_id,
                  measured.stamp_sd_s,     measured.stamp_source};
  bearing.pose_revision = pointing.pose_revision();
  bearing.sight.origin_sd_enu_m = pointing.pose().position_sd_enu_m;
  bearing.pixel = measured.output.pixel;
  bearing.covariance_px2 = measured.output.covariance_px2;
  bearing.designation_sd_px = measured.designation_sd_px;
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
  counters_["bearings"] += 1;
  constexpr double kSmoothing = 0.1;
  frame_latency_s_ += kSmoothing * (now_s - bearing.mid_exposure_s - frame_latency_s_);
  return true;
}

}  // namespace ols::station
