#include "edge/ptu/motion_commands.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "geometry/angles.h"

namespace ols {

namespace {

// There is no checksum: a command that was changed on its way holds no longer than this.
constexpr double kRefresh_s = 1.0;
constexpr double kHaltMargin_s = 0.3;  // on top of the braking time, before a halt is repeated
constexpr double kStanding_counts_s = 20.0;  // slower than this is standing

constexpr double kRounding_counts = 1e-6;  // a limit that is a whole count stays that count

double least_within(const PtuAxisFacts& facts, double least_rad) {
  return std::ceil(least_rad / facts.resolution_rad - kRounding_counts);
}

double greatest_within(const PtuAxisFacts& facts, double greatest_rad) {
  return std::floor(greatest_rad / facts.resolution_rad + kRounding_counts);
}

PtuLimits narrowed(const PtuLimits& configured, const PtuFacts& facts) {
  return {std::max(configured.pan_min_rad, facts.pan.least * facts.pan.resolution_rad),
          std::min(configured.pan_max_rad, facts.pan.greatest * facts.pan.resolution_rad),
          std::max(configured.tilt_min_rad, facts.tilt.least * facts.tilt.resolution_rad),
          std::min(configured.tilt_max_rad, facts.tilt.greatest * facts.tilt.resolution_rad)};
}

struct Range {
  double least_rad, greatest_rad;
};

std::string axis_conflict(const char* name, const PtuAxisFacts& facts, const Range& configured,
                          const Range& both) {
  const bool room =
      both.least_rad < both.greatest_rad &&
      least_within(facts, both.least_rad) <= greatest_within(facts, both.greatest_rad);
  if (room) return {};
  char text[200];
  std::snprintf(text, sizeof text,
                "no %s lies within both the configured limits, %.2f to %.2f deg, and the unit's, "
                "%.2f to %.2f deg",
                name, degrees(configured.least_rad), degrees(configured.greatest_rad),
                degrees(facts.least * facts.resolution_rad),
                degrees(facts.greatest * facts.resolution_rad));
  return text;
}

}  // namespace

std::string limits_conflict(const PtuLimits& configured, const PtuFacts& facts) {
  const PtuLimits both = narrowed(configured, facts);
  std::string pan =
      axis_conflict("pan", facts.pan, {configured.pan_min_rad, configured.pan_max_rad},
                    {both.pan_min_rad, both.pan_max_rad});
  if (!pan.empty()) return pan;
  return axis_conflict("tilt", facts.tilt, {configured.tilt_min_rad, configured.tilt_max_rad},
                       {both.tilt_min_rad, both.tilt_max_rad});
}

MotionCommands::MotionCommands(const PtuConfig& config, const PtuFacts& facts)
    : servo_(config.servo),
      limits_(narrowed(config.limits, facts)),
      pan_(axis(PtuAxis::kPan, facts.pan, limits_.pan_min_rad, limits_.pan_max_rad)),
      tilt_(axis(PtuAxis::kTilt, facts.tilt, limits_.tilt_min_rad, limits_.tilt_max_rad)) {
  const auto rad = [](const PtuAxisFacts& axis, std::int32_t counts) {
    return counts * axis.resolution_rad;
  };
  servo_.max_speed_rad_s = std::min({servo_.max_speed_rad_s, rad(facts.pan, facts.pan.upper_speed),
                                     rad(facts.tilt, facts.tilt.upper_speed)});
  servo_.min_speed_rad_s = std::max({servo_.min_speed_rad_s, rad(facts.pan, facts.pan.lower_speed),
                                     rad(facts.tilt, facts.tilt.lower_speed)});
  // What the unit really does decides where it can stop.
  servo_.max_acceleration_rad_s2 =
      std::min(rad(facts.pan, facts.pan.acceleration), rad(facts.tilt, facts.tilt.acceleration));
  braking_s_ = servo_.max_speed_rad_s / servo_.max_acceleration_rad_s2;
}

MotionCommands::Axis MotionCommands::axis(PtuAxis name, const PtuAxisFacts& facts, double least_rad,
                                          double greatest_rad) {
  return {name,
          facts,
          static_cast<std::int32_t>(least_within(facts, least_rad)),
          static_cast<std::int32_t>(greatest_within(facts, greatest_rad)),
          {},
          {},
          {},
          0.0};
}

PtuRequest MotionCommands::next(const std::optional<ServoGoal>& goal, const PanTilt& now,
                                double time_s) {
  PtuRequest request;
  const auto command = servo_step(servo_, limits_, goal, now, time_s);
  if (!command) {
    halt(time_s, request);
    return request;
  }
  halted_s_.reset();
  if (time_s - refreshed_s_ >= kRefresh_s) send_all_again();
  if (!pan_.position) refreshed_s_ = time_s;
  add_speed(pan_, command->speed.pan_rad, request);
  add_speed(tilt_, command->speed.tilt_rad, request);
  add_position(pan_, command->position.pan_rad, request);
  add_position(tilt_, command->position.tilt_rad, request);
  return request;
}

void MotionCommands::halt(double time_s, PtuRequest& request) {
  const bool moving = std::abs(pan_.rate_counts_s) > kStanding_counts_s ||
                      std::abs(tilt_.rate_counts_s) > kStanding_counts_s;
  const bool again = moving && halted_s_ && time_s - *halted_s_ > braking_s_ + kHaltMargin_s;
  if (halted_s_ && !again) return;
  halted_s_ = time_s;
  request.plain("H");
  send_all_again();
}

void MotionCommands::send_all_again() {
  for (Axis* axis : {&pan_, &tilt_}) {
    axis->position.reset();
    axis->speed.reset();
  }
}

void MotionCommands::add_speed(Axis& axis, double speed_rad_s, PtuRequest& request) {
  const auto speed =
      std::clamp(static_cast<std::int32_t>(std::lround(speed_rad_s / axis.facts.resolution_rad)),
                 std::max(1, axis.facts.lower_speed), axis.facts.upper_speed);
  if (axis.speed == speed) return;
  axis.speed = speed;
  request.set(axis.name, PtuQuantity::kSpeed, speed);
}

void MotionCommands::add_position(Axis& axis, double position_rad, PtuRequest& request) {
  const auto position =
      std::clamp(static_cast<std::int32_t>(std::lround(position_rad / axis.facts.resolution_rad)),
                 axis.least, axis.greatest);
  if (axis.position == position) return;
  axis.position = position;
  request.set(axis.name, PtuQuantity::kPosition, position);
}

// No faster than the unit goes and, when its speed is known, no further from there than it
// accelerates, and than it goes within the doubt about the two instants (which also is in the
// speed).
bool MotionCommands::reachable(const Axis& axis, std::int32_t counts, double dt_s,
                               double doubt_s) const {
  constexpr double kSlack_counts = 60.0;
  if (!axis.read) return true;
  const double way = static_cast<double>(counts) - *axis.read;
  const double fastest = 1.2 * axis.facts.upper_speed;
  if (std::abs(way) > fastest * (dt_s + doubt_s) + kSlack_counts) return false;
  if (!axis.rate_known) return true;
  const double surprise = std::abs(way - axis.rate_counts_s * dt_s);
  const double accelerated = 1.2 * axis.facts.acceleration * dt_s * (dt_s + read_gap_s_);
  return surprise <= accelerated + 2.0 * std::abs(axis.rate_counts_s) * doubt_s + kSlack_counts;
}

bool MotionCommands::plausible(std::int32_t pan_counts, std::int32_t tilt_counts, double time_s,
                               double doubt_s) {
  const double dt_s = time_s - read_s_;
  const double both_s = doubt_s + doubt_s_;
  if (!reachable(pan_, pan_counts, dt_s, both_s) || !reachable(tilt_, tilt_counts, dt_s, both_s)) {
    // It may be the last one that was wrong.
    pan_.rate_known = tilt_.rate_known = false;
    return false;
  }
  for (auto& [axis, counts] : {std::pair(&pan_, pan_counts), std::pair(&tilt_, tilt_counts)}) {
    axis->rate_known = axis->read && dt_s > 0.0;
    axis->rate_counts_s =
        axis->rate_known ? (static_cast<double>(counts) - *axis->read) / dt_s : 0.0;
    axis->read = counts;
  }
  read_gap_s_ = dt_s;
  read_s_ = time_s;
  doubt_s_ = doubt_s;
  return true;
}

}  // namespace ols
