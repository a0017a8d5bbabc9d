#include "edge/ptu/angle_intake.h"

#include <algorithm>

namespace ols::ptu {

namespace {

mount::AngleHistory::Config history_config(const PtuConfig& config, const PtuFacts& facts) {
  mount::AngleHistory::Config history = config.history;
  history.step_rad = facts.pan.resolution_rad;
  return history;
}

}  // namespace

AngleIntake::AngleIntake(const PtuConfig& config, const PtuFacts& facts)
    : poll_interval_s_(config.poll_interval_s),
      acceleration_max_rad_s2_(config.history.acceleration_max_rad_s2),
      check_(facts),
      history_(history_config(config, facts)) {}

void AngleIntake::commanded(const PanTilt& change_rad_s) {
  change_rad_s_ = {std::max(change_rad_s_.pan_rad, change_rad_s.pan_rad),
                   std::max(change_rad_s_.tilt_rad, change_rad_s.tilt_rad)};
}

PositionCheck::Verdict AngleIntake::take(const PollCycle& done, const PanTilt& change_rad_s,
                                         double time_s) {
  const auto verdict = check_.take(done.pan(), done.tilt(), commanded_rad_s2(time_s));
  if (verdict != PositionCheck::Verdict::kBelieved) return verdict;
  change_rad_s_ = change_rad_s;
  if (!history_.add(check_.sample())) return verdict;
  last_good_s_ = time_s;
  samples_.add(check_.sample());
  return verdict;
}

// The approximate commanded acceleration since the last sample. If a cycle was lost in between, the
// speed may have changed at once in the middle.
PanTilt AngleIntake::commanded_rad_s2(double time_s) const {
  constexpr double kShare = 0.8;  // it may begin or end anywhere between the samples
  const double gap_s = std::max(1e-3, time_s - last_good_s_.value_or(time_s));
  const double at_once = gap_s > 1.8 * poll_interval_s_ ? 2.0 : 1.0;
  const auto commanded = [=, this](double change_rad_s) {
    return kShare * std::min(acceleration_max_rad_s2_, at_once * change_rad_s / gap_s);
  };
  return {commanded(change_rad_s_.pan_rad), commanded(change_rad_s_.tilt_rad)};
}

std::optional<PanTilt> AngleIntake::angles_at(double time_s) const {
  if (const auto interpolated = history_.at(time_s)) return interpolated->angles;
  const auto newest = history_.newest();
  return newest ? std::optional(newest->angles) : std::nullopt;
}

std::optional<double> AngleIntake::newest_s() const {
  const auto newest = history_.newest();
  return newest ? std::optional(newest->time_s) : std::nullopt;
}

}  // namespace ols::ptu
