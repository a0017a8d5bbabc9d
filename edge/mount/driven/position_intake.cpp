#include "edge/mount/onvif/position_intake.h"

#include <algorithm>
#include <cmath>

namespace ols::onvif {
namespace {

constexpr double kSmoothing = 0.1;  // of what is averaged over answers
constexpr double kOftenOld = 0.2;   // share of old positions from which the age of new ones counts
constexpr double kSettled_s = 3.0;  // after a motion
constexpr int kRestCount = 20;      // positions from which their scatter is known
constexpr double kMotion = 5.0;     // 1-sigmas of the configuration: no scatter
const double kUniform = std::sqrt(12.0);  // width over 1-sigma of a uniform distribution

}  // namespace

double distance(const PanTilt& a, const PanTilt& b) {
  return std::max(std::abs(a.pan_rad - b.pan_rad), std::abs(a.tilt_rad - b.tilt_rad));
}

void PositionIntake::restart() {
  last_.reset();
  rest_count_ = 0;
  moved_ = false;
}

double PositionIntake::interval_s() const { return moved_ ? poll_s_ / (1.0 - old_share_) : 0.0; }

double PositionIntake::sd_rad() const {
  const double scatter = rest_count_ < kRestCount ? 0.0 : std::sqrt(rest_variance_rad2_);
  return std::max(config_.sd_rad, scatter);
}

void PositionIntake::measure_rest(const PanTilt& angles, double now_s, double ordered_rad_s) {
  if (ordered_rad_s > 0.0) {
    rests_since_s_ = now_s;
    rest_count_ = 0;
  }
  if (now_s - rests_since_s_ < kSettled_s) return;
  // A camera that moves without an order does not scatter.
  if (rest_count_ > 0 && distance(angles, rest_mean_) > kMotion * config_.sd_rad) rest_count_ = 0;
  if (rest_count_ == 0) {
    rest_mean_ = angles;
    rest_variance_rad2_ = 0.0;
  }
  const double weight = std::max(1.0 / (++rest_count_), kSmoothing);
  const double pan = angles.pan_rad - rest_mean_.pan_rad;
  const double tilt = angles.tilt_rad - rest_mean_.tilt_rad;
  rest_mean_.pan_rad += weight * pan;
  rest_mean_.tilt_rad += weight * tilt;
  rest_variance_rad2_ += weight * (std::max(pan * pan, tilt * tilt) - rest_variance_rad2_);
}

void PositionIntake::add(const PanTilt& angles, double sent_s, double answered_s,
                         double ordered_rad_s) {
  const double trip_s = answered_s - sent_s;
  const double now_s = 0.5 * (sent_s + answered_s);
  if (!last_) {
    round_trip_s_ = trip_s;
    changed_s_ = now_s;
    poll_s_ = 0.0;
  }
  round_trip_s_ += kSmoothing * (trip_s - round_trip_s_);
  const double gap_s = last_ ? now_s - last_s_ : 0.0;
  if (last_) poll_s_ = poll_s_ == 0.0 ? gap_s : poll_s_ + kSmoothing * (gap_s - poll_s_);
  const bool changed = !last_ || distance(angles, *last_) > 0.0;
  if (changed) changed_s_ = now_s;
  const bool old = ordered_rad_s * (now_s - changed_s_) > 2.0 * sd_rad();
  if (ordered_rad_s * poll_s_ > 2.0 * sd_rad()) {  // each position should differ from the last
    old_share_ += kSmoothing * ((old ? 1.0 : 0.0) - old_share_);
    moved_ = true;
  }
  measure_rest(angles, now_s, ordered_rad_s);
  last_ = angles;
  last_s_ = now_s;
  if (old) return;
  const double age_s = ordered_rad_s > 0.0 && old_share_ > kOftenOld ? gap_s : 0.0;
  samples_.add({.time_s = now_s - config_.delay_s - 0.5 * age_s,
                .time_sd_s = std::hypot(trip_s / kUniform, age_s / kUniform, config_.delay_sd_s),
                .angles = angles,
                .doubt = {sd_rad(), sd_rad()}});
}

}  // namespace ols::onvif
