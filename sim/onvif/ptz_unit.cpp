#include "sim/onvif/ptz_unit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ols::sim {
namespace {

constexpr double kStep_rad = radians(1e-3);  // of the motors
constexpr double kKept_s = 15.0;

double stepped(double angle_rad, double step_rad) {
  return step_rad > 0.0 ? step_rad * std::round(angle_rad / step_rad) : angle_rad;
}

}  // namespace

PtzUnit::PtzUnit(const PtzUnitConfig& config, std::uint64_t seed, double time_s)
    : config_(config),
      axes_{PtuAxis(0.0, time_s), PtuAxis(0.0, time_s)},
      random_(seed),
      booted_s_(-std::numeric_limits<double>::infinity()) {}

PtuAxis::Profile PtzUnit::profile(double speed_rad_s) const {
  return {speed_rad_s / kStep_rad, config_.acceleration_rad_s2 / kStep_rad, 0.0};
}

void PtzUnit::set_faults(const PtzFaults& faults, double time_s) {
  const PtzFaults before = std::exchange(faults_, faults);
  if (!faults.frozen) frozen_.reset();
  if (faults.frozen && !before.frozen) frozen_ = counted_at(time_s);
  if (!faults.reboots || before.reboots) return;
  booted_s_ = time_s + config_.boot_s;
  for (PtuAxis& axis : axes_) axis.move(0.0, profile(config_.max_speed_rad_s), time_s);
}

void PtzUnit::drive(Axis axis, double speed_rad_s, double lasts_s, double time_s) {
  forget(time_s);
  const double start_s = time_s + config_.command_delay_s;
  if (speed_rad_s == 0.0) return brake(axis, start_s);
  const PanTilt& end = speed_rad_s > 0.0 ? config_.greatest : config_.least;
  const double end_rad = axis == kPan ? end.pan_rad : end.tilt_rad;
  axes_[axis].move(end_rad / kStep_rad, profile(std::abs(speed_rad_s)), start_s);
  if (!faults_.ignores_timeout) brake(axis, start_s + lasts_s);
}

void PtzUnit::go_to(Axis axis, double target_rad, double speed_rad_s, double time_s) {
  forget(time_s);
  if (config_.repeatability_rad > 0.0) {
    missed_rad_[axis] = std::normal_distribution(0.0, config_.repeatability_rad)(random_);
    target_rad += missed_rad_[axis];
  }
  axes_[axis].move(target_rad / kStep_rad, profile(speed_rad_s), time_s + config_.command_delay_s);
}

void PtzUnit::stop(double time_s) {
  if (faults_.ignores_stop) return;
  for (const Axis axis : {kPan, kTilt}) brake(axis, time_s + config_.command_delay_s);
}

void PtzUnit::brake(Axis axis, double time_s) {
  axes_[axis].halt(profile(config_.max_speed_rad_s), time_s);
}

bool PtzUnit::moves(double time_s) const {
  return std::ranges::any_of(axes_, [=](const PtuAxis& a) { return a.velocity(time_s) != 0.0; });
}

std::optional<PanTilt> PtzUnit::reported(double time_s) const {
  if (faults_.no_position) return std::nullopt;
  const PanTilt now = frozen_ ? *frozen_ : counted_at(time_s - faults_.late_s);
  const double step_rad = radians(faults_.step_deg);
  return PanTilt{stepped(now.pan_rad, step_rad), stepped(now.tilt_rad, step_rad)};
}

// The angles as the unit counts them.
PanTilt PtzUnit::counted_at(double time_s) const {
  const PanTilt at = angles_at(time_s);
  return {at.pan_rad - missed_rad_[kPan], at.tilt_rad - missed_rad_[kTilt]};
}

PanTilt PtzUnit::angles_at(double time_s) const {
  return {axes_[kPan].position(time_s) * kStep_rad, axes_[kTilt].position(time_s) * kStep_rad};
}

void PtzUnit::forget(double time_s) {
  for (PtuAxis& axis : axes_) axis.forget(time_s - kKept_s);
}

}  // namespace ols::sim
