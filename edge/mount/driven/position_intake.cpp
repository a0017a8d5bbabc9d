#include "edge/mount/driven/position_intake.h"

#include <algorithm>
#include <cmath>

namespace ols::mount {
namespace {

constexpr double kSmoothing = 0.1;  // weight of a new answer in averages
constexpr double kOftenOld = 0.2;   // share of old positions above which the age of new ones counts
constexpr double kSettled_s = 3.0;  // after a motion
constexpr int kRestCount = 20;      // positions that determine their scatter
constexpr double kMotion = 5.0;     // in configured sigmas; more is no scatter
constexpr double kSpreadSmoothing = 0.05;
constexpr double kLeast = 0.01;           // of the variance; at least this much is stated
constexpr double kWorst = 3.0;            // of the variance: all at one end of the round trip
constexpr double kResponds_s = 0.5;       // after an order, a mount still changes its rate
constexpr double kKept_s = 10.0;          // so long, orders are kept
constexpr double kSteady = 0.05;          // share of the rate; a smaller change does not count
const double kUniform = std::sqrt(12.0);  // width over 1-sigma of a uniform distribution

}  // namespace

double distance(const PanTilt& a, const PanTilt& b) {
  return std::max(std::abs(a.pan_rad - b.pan_rad), std::abs(a.tilt_rad - b.tilt_rad));
}

void PositionIntake::restart() {
  last_.reset();
  rest_count_ = 0;
  moved_ = false;
  orders_.clear();
  moved_in_row_ = {};
  added_s_.reset();
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
  // A larger deviation is no scatter: the camera has moved without an order.
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

void PositionIntake::ordered(const std::optional<PanTilt>& rate, double now_s) {
  orders_.push_back({now_s, rate});
  while (orders_.size() > 1 && orders_[1].time_s < now_s - kKept_s) orders_.pop_front();
}

// The change of the ordered rate since then, from the order that was in force then; nullopt if one
// of the orders is not known.
std::optional<PanTilt> PositionIntake::ordered_change(double since_s) const {
  PanTilt least, most;
  for (auto order = orders_.rbegin(); order != orders_.rend(); ++order) {
    if (!order->rate) return std::nullopt;
    const bool first = order == orders_.rbegin();
    const PanTilt& rate = *order->rate;
    least = first ? rate
                  : PanTilt{std::min(least.pan_rad, rate.pan_rad),
                            std::min(least.tilt_rad, rate.tilt_rad)};
    most = first ? rate
                 : PanTilt{std::max(most.pan_rad, rate.pan_rad),
                           std::max(most.tilt_rad, rate.tilt_rad)};
    if (order->time_s <= since_s)
      return PanTilt{most.pan_rad - least.pan_rad, most.tilt_rad - least.tilt_rad};
  }
  return std::nullopt;
}

// Learns from the axis that turns faster.
void PositionIntake::learn_spread(const Moved& newest) {
  moved_in_row_ = {moved_in_row_[1], moved_in_row_[2], newest};
  const auto& [x, y, z] = moved_in_row_;
  const auto change = ordered_change(x.time_s - kResponds_s);
  if (x.time_s == 0.0 || !change) return;
  const double span_s = z.time_s - x.time_s, last = (y.time_s - x.time_s) / span_s;
  const auto turn = [](const Moved& from, const Moved& to, double PanTilt::*axis) {
    return to.angles.*axis - from.angles.*axis;
  };
  const bool pans =
      std::abs(turn(x, z, &PanTilt::pan_rad)) > std::abs(turn(x, z, &PanTilt::tilt_rad));
  const auto axis = pans ? &PanTilt::pan_rad : &PanTilt::tilt_rad;
  const double rate = turn(x, z, axis) / span_s;
  if (std::abs(rate) * poll_s_ < 2.0 * sd_rad() || *change.*axis > kSteady * std::abs(rate)) return;
  const double first = 1.0 - last, off_rad = turn(x, y, axis) - last * turn(x, z, axis);
  const double weights = 1.0 + first * first + last * last;
  // Averaged in rad^2, because fast turns show the spread best.
  const double whole_rad2 =
      rate * rate *
      (y.spread_s * y.spread_s + std::pow(first * x.spread_s, 2) + std::pow(last * z.spread_s, 2));
  const double seen_rad2 =
      std::min(off_rad * off_rad - weights * sd_rad() * sd_rad(), kWorst * whole_rad2);
  if (whole_spread_rad2_ == 0.0) seen_spread_rad2_ = whole_spread_rad2_ = whole_rad2;
  seen_spread_rad2_ += kSpreadSmoothing * (seen_rad2 - seen_spread_rad2_);
  whole_spread_rad2_ += kSpreadSmoothing * (whole_rad2 - whole_spread_rad2_);
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
  const double time_s = now_s - config_.delay_s - 0.5 * age_s;
  const double spread_s = std::hypot(trip_s, age_s) / kUniform;
  if (ordered_rad_s > 0.0) learn_spread({time_s, spread_s, angles});
  const double share = whole_spread_rad2_ > 0.0
                           ? std::clamp(seen_spread_rad2_ / whole_spread_rad2_, kLeast, kWorst)
                           : 1.0;
  samples_.add({.time_s = time_s,
                .time_sd_s = std::sqrt(share) * spread_s,
                .angles = angles,
                .place_sd = {sd_rad(), sd_rad()},
                .ordered_change = ordered_change(added_s_.value_or(time_s) - kResponds_s),
                .shared_time_sd_s = config_.delay_sd_s});
  added_s_ = time_s;
}

}  // namespace ols::mount
