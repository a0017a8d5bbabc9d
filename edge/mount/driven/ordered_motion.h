// The motion that a mount was last ordered to make, and since when it should stand.
#pragma once

#include <optional>

#include "geometry/kinematic_chain.h"

namespace ols::mount {

struct OrderedMotion {
  enum class Kind { kNone, kVelocity, kAbsolute };
  Kind kind = Kind::kNone;
  PanTilt rate;                         // [rad/s] of a velocity, otherwise 0
  PanTilt place;                        // [rad] of the last move to a position
  double ordered_s = 0.0;               // time of the last order of a motion; 0: none yet
  double stop_s = -1e9;                 // time of the last stop
  std::optional<double> rests_since_s;  // time of the first accepted stop since the last motion
  std::optional<double> arrived_s;      // when it was first reported at `place`

  // After the end of its motion, the mount must not move any more from then on.
  static constexpr double kRested_s = 3.0;

  // Since when the camera should not move any more; nullopt if it should move.
  const std::optional<double>& still_since_s() const {
    return kind == Kind::kNone ? rests_since_s : arrived_s;
  }
};

// What a judgement of the mount's motion demands. A greater value includes the smaller ones.
enum class Demand { kNothing, kStop, kGiveUp };  // kGiveUp: order no motion for some time

// The last time at which something was seen. It is alarmed for half a minute.
class Sighted {
 public:
  void at(double time_s) { time_s_ = time_s; }
  void forget() { time_s_.reset(); }
  bool holds(double now_s) const { return time_s_ && now_s - *time_s_ < 30.0; }

 private:
  std::optional<double> time_s_;
};

}  // namespace ols::mount
