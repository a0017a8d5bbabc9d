// Turns a mount a little on each axis, there and back, and measures what its positions show of it.
// Pure.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "edge/mount/angle_history.h"
#include "edge/mount/goal.h"
#include "edge/mount/limits.h"

namespace ols::doctor {

struct AxisMotion {
  double ordered_rad = 0.0;             // 0: there was no room
  double turned_rad = 0.0;              // by its positions
  std::optional<double> shown_after_s;  // from the order until a position shows the motion
  double left_rad = 0.0;                // from where it began, after the way back
};
// Pan, tilt.
using Motions = std::array<AxisMotion, 2>;

class MotionProbe {
 public:
  // `start`: where the mount is. It turns to the side that has room within the limits.
  MotionProbe(const mount::Limits& limits, const PanTilt& start);

  // `arrived`: the samples since the last call. nullopt: it is over, and the mount is to halt.
  std::optional<mount::Goal> next(double now_s, const std::vector<mount::AngleSample>& arrived);
  const Motions& motions() const { return motions_; }

 private:
  void take(const PanTilt& angles, double now_s);
  void begin_leg(double now_s);
  bool leg_ended(double now_s) const;
  PanTilt target() const;

  PanTilt start_;
  Motions motions_;
  int leg_ = -1;  // pan there, pan back, tilt there, tilt back
  double began_s_ = 0.0;
  PanTilt at_, stands_at_;
  double stands_since_s_ = 0.0;
};

}  // namespace ols::doctor
