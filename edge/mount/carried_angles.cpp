#include "edge/mount/carried_angles.h"

#include <algorithm>
#include <cmath>

namespace ols::mount {
namespace {

CarriedAxis::Seen seen_of(const SeenPath::At& at, double PanTilt::*axis) {
  return {at.time_s, at.turned.*axis, at.rate.*axis, at.walk.*axis, at.bend.*axis};
}

}  // namespace

CarriedAxis::Report CarriedAngles::report(const AngleSample& sample, double PanTilt::*axis,
                                          double time_sd_s) const {
  const double step_rad2 = sample.step_share.*axis * config_.step_rad * config_.step_rad / 12.0;
  const double other_rad = std::hypot(sample.doubt.*axis, sample.place_sd.*axis);
  return {sample.angles.*axis, step_rad2 + other_rad * other_rad, time_sd_s,
          std::hypot(sample.shared_time_sd_s, stamp_sd_s_)};
}

void CarriedAngles::clear() {
  path_.clear();
  pan_ = tilt_ = {};
  waiting_.clear();
}

void CarriedAngles::add(const AngleSample& sample) {
  waiting_.push_back(sample);
  while (waiting_.front().time_s < sample.time_s - config_.span_s) waiting_.pop_front();
  use_reports();
}

void CarriedAngles::add(const SeenTurn& turn) {
  const auto added = path_.add(turn);
  if (added == SeenPath::Added::kIgnored) return;
  stamp_sd_s_ = turn.stamp_sd_s;
  if (added == SeenPath::Added::kBegun) {
    pan_.lose_angle();
    tilt_.lose_angle();
  }
  use_reports();
}

void CarriedAngles::use_reports() {
  while (!waiting_.empty()) {
    const AngleSample& sample = waiting_.front();
    const double tilt_s = sample.time_s + sample.tilt_delay_s;
    if (!path_.covers(std::max(sample.time_s, tilt_s))) return;
    const auto at_pan = path_.at(sample.time_s), at_tilt = path_.at(tilt_s);
    if (at_pan && at_tilt) {
      pan_.add(report(sample, &PanTilt::pan_rad, sample.time_sd_s),
               seen_of(*at_pan, &PanTilt::pan_rad));
      tilt_.add(
          report(sample, &PanTilt::tilt_rad, sample.tilt_time_sd_s.value_or(sample.time_sd_s)),
          seen_of(*at_tilt, &PanTilt::tilt_rad));
    }
    waiting_.pop_front();
  }
}

std::optional<AngleAt> CarriedAngles::at(double time_s) const {
  const auto seen = path_.at(time_s);
  const auto newest_s = pan_.newest_s();
  if (!seen || !newest_s || time_s - *newest_s > config_.span_s) return std::nullopt;
  const auto pan = pan_.at(seen_of(*seen, &PanTilt::pan_rad));
  const auto tilt = tilt_.at(seen_of(*seen, &PanTilt::tilt_rad));
  AngleAt result;
  result.angles = {pan->angle_rad, tilt->angle_rad};
  result.rate = {pan->rate_rad_s, tilt->rate_rad_s};
  result.covariance = Eigen::Vector2d(pan->variance_rad2, tilt->variance_rad2).asDiagonal();
  result.lasting_covariance = Eigen::Vector2d(pan->lasting_rad2, tilt->lasting_rad2).asDiagonal();
  return result;
}

}  // namespace ols::mount
