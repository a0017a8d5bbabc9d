#include "sim/ptu/axis.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ols::sim {

namespace {

double braking_distance(double speed, double end_speed, double acceleration) {
  return std::max(0.0, speed * speed - end_speed * end_speed) / (2.0 * acceleration);
}

}  // namespace

PtuAxis::PtuAxis(double position_counts, double time_s)
    : segments_{{time_s, position_counts, 0.0, 0.0}} {}

const PtuAxis::Segment& PtuAxis::segment(double time_s) const {
  const auto after =
      std::upper_bound(segments_.begin(), segments_.end(), time_s,
                       [](double time, const Segment& segment) { return time < segment.start_s; });
  return after == segments_.begin() ? segments_.front() : *std::prev(after);
}

double PtuAxis::position(double time_s) const {
  const Segment& s = segment(time_s);
  const double t = std::max(0.0, time_s - s.start_s);
  return s.position + s.velocity * t + 0.5 * s.acceleration * t * t;
}

double PtuAxis::velocity(double time_s) const {
  const Segment& s = segment(time_s);
  return s.velocity + s.acceleration * std::max(0.0, time_s - s.start_s);
}

// The current last segment gets this motion for `duration_s` and is followed by rest.
void PtuAxis::append(double duration_s, double velocity, double acceleration) {
  Segment& last = segments_.back();
  last.velocity = velocity;
  last.acceleration = acceleration;
  const double end =
      last.position + velocity * duration_s + 0.5 * acceleration * duration_s * duration_s;
  segments_.push_back({last.start_s + duration_s, end, 0.0, 0.0});
}

// Accelerate, cruise, decelerate from the last segment's position, entered at `entry_speed` towards
// a target that can be reached without reversing.
void PtuAxis::travel(double target_counts, double entry_speed, const Profile& profile) {
  const double a = profile.acceleration;
  const double path = target_counts - segments_.back().position;
  const double sign = path < 0.0 ? -1.0 : 1.0;
  const double base = std::min(profile.base_speed, profile.speed);
  double left = std::abs(path);
  double speed = std::max(entry_speed, base);
  if (speed > profile.speed) {
    left -= braking_distance(speed, profile.speed, a);
    append((speed - profile.speed) / a, sign * speed, -sign * a);
    speed = profile.speed;
  }
  const double highest =
      std::max(speed, std::sqrt(std::max(0.0, a * left + 0.5 * (speed * speed + base * base))));
  const double cruise = std::min(profile.speed, highest);
  const double ramps = braking_distance(cruise, speed, a) + braking_distance(cruise, base, a);
  append((cruise - speed) / a, sign * speed, sign * a);
  append(std::max(0.0, left - ramps) / cruise, sign * cruise, 0.0);
  append((cruise - base) / a, sign * cruise, -sign * a);
  segments_.back().position = target_counts;  // without rounding errors
}

void PtuAxis::move(double target_counts, const Profile& profile, double time_s) {
  const double here = position(time_s);
  const double speed = velocity(time_s);
  while (segments_.size() > 1 && segments_.back().start_s >= time_s) segments_.pop_back();
  segments_.push_back({time_s, here, 0.0, 0.0});
  if (target_counts == here && speed == 0.0) return;

  const double base = std::min(profile.base_speed, profile.speed);
  const double path = target_counts - here;
  const bool towards = speed * path > 0.0;
  const double slack = 1e-6;
  const bool fits =
      braking_distance(std::abs(speed), base, profile.acceleration) <= std::abs(path) + slack;
  if (speed == 0.0 || (towards && fits)) {
    travel(target_counts, std::abs(speed), profile);
    return;
  }
  const double sign = speed < 0.0 ? -1.0 : 1.0;
  const double down = std::max(0.0, std::abs(speed) - base) / profile.acceleration;
  append(down, speed, -sign * profile.acceleration);
  if (segments_.back().position != target_counts) travel(target_counts, 0.0, profile);
}

void PtuAxis::halt(const Profile& profile, double time_s) {
  const double speed = velocity(time_s);
  const double here = position(time_s);
  if (speed == 0.0) {
    move(std::round(here), profile, time_s);
    return;
  }
  const double base = std::min(profile.base_speed, profile.speed);
  const double stop = braking_distance(std::abs(speed), base, profile.acceleration);
  const double end = speed < 0.0 ? std::floor(here - stop) : std::ceil(here + stop);
  move(end, profile, time_s);
}

void PtuAxis::shift(double counts, double time_s) {
  Segment from_now = segment(time_s);
  from_now.position = position(time_s);
  from_now.velocity = velocity(time_s);
  from_now.start_s = std::max(time_s, segments_.front().start_s);
  auto after =
      std::upper_bound(segments_.begin(), segments_.end(), from_now.start_s,
                       [](double time, const Segment& segment) { return time < segment.start_s; });
  after = segments_.insert(after, from_now);
  for (; after != segments_.end(); ++after) after->position += counts;
}

void PtuAxis::forget(double before_s) {
  while (segments_.size() > 1 && segments_[1].start_s <= before_s) segments_.pop_front();
}

}  // namespace ols::sim
