#include "tools/doctor/motion_probe.h"

#include <algorithm>
#include <cmath>

#include "geometry/angles.h"

namespace ols::doctor {
namespace {

constexpr double kTurn_rad = radians(3.0);
constexpr double kShown_rad = radians(0.3);  // of a motion: no scatter
constexpr double kStands_rad = radians(0.02), kStands_s = 1.5;
constexpr double kLeast_s = 3.0, kMost_s = 12.0;  // of one way
constexpr double kGoal_s = 0.5;                   // it halts after it, if no other comes
constexpr int kLegs = 4;

constexpr std::array kAxes{&PanTilt::pan_rad, &PanTilt::tilt_rad};

bool is_free(const mount::Limits& limits, const PanTilt& from, const PanTilt& to) {
  const mount::AngleBox travel = mount::travel(limits);
  return to.pan_rad > travel.pan_min_rad && to.pan_rad < travel.pan_max_rad &&
         to.tilt_rad > travel.tilt_min_rad && to.tilt_rad < travel.tilt_max_rad &&
         !mount::blocked(limits.keep_out, mount::spanned(from, to));
}

}  // namespace

MotionProbe::MotionProbe(const mount::Limits& limits, const PanTilt& start)
    : start_(start), at_(start), stands_at_(start) {
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    for (const double turn_rad : {kTurn_rad, -kTurn_rad}) {
      PanTilt to = start;
      to.*kAxes[axis] += turn_rad;
      if (motions_[axis].ordered_rad == 0.0 && is_free(limits, start, to))
        motions_[axis].ordered_rad = turn_rad;
    }
  }
}

PanTilt MotionProbe::target() const {
  PanTilt to = start_;
  const auto axis = static_cast<std::size_t>(leg_ / 2);
  if (leg_ % 2 == 0) to.*kAxes[axis] += motions_[axis].ordered_rad;
  return to;
}

void MotionProbe::begin_leg(double now_s) {
  ++leg_;
  began_s_ = stands_since_s_ = now_s;
  stands_at_ = at_;
}

void MotionProbe::take(const PanTilt& angles, double now_s) {
  at_ = angles;
  const double moved_rad = std::max(std::abs(at_.pan_rad - stands_at_.pan_rad),
                                    std::abs(at_.tilt_rad - stands_at_.tilt_rad));
  if (moved_rad > kStands_rad) {
    stands_at_ = at_;
    stands_since_s_ = now_s;
  }
  const auto axis = static_cast<std::size_t>(leg_ / 2);
  AxisMotion& motion = motions_[axis];
  const double from_start_rad = at_.*kAxes[axis] - start_.*kAxes[axis];
  (leg_ % 2 == 0 ? motion.turned_rad : motion.left_rad) = from_start_rad;
  if (leg_ == 2 * static_cast<int>(axis) && !motion.shown_after_s &&
      std::abs(from_start_rad) > kShown_rad)
    motion.shown_after_s = now_s - began_s_;
}

bool MotionProbe::leg_ended(double now_s) const {
  const bool stands = now_s - began_s_ > kLeast_s && now_s - stands_since_s_ > kStands_s;
  return stands || now_s - began_s_ > kMost_s;
}

std::optional<mount::Goal> MotionProbe::next(double now_s,
                                             const std::vector<mount::AngleSample>& arrived) {
  if (leg_ < 0) begin_leg(now_s);
  for (const mount::AngleSample& sample : arrived)
    if (leg_ < kLegs) take(sample.angles, now_s);
  const auto skipped = [&] {
    return motions_[static_cast<std::size_t>(leg_ / 2)].ordered_rad == 0.0;
  };
  while (leg_ < kLegs && (skipped() || leg_ended(now_s))) begin_leg(now_s);
  if (leg_ >= kLegs) return std::nullopt;
  return mount::Goal{now_s, target(), {}, now_s + kGoal_s, false, true};
}

}  // namespace ols::doctor
