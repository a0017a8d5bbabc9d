// Remembers the direction from which each axis has come to its angle. The effect of backlash
// depends on this direction. Pure.
#pragma once

#include <deque>

#include "geometry/kinematic_chain.h"

namespace ols::mount {

// For each axis, the sign of its last motion in counts, 1 or -1; 0 if the axis has not moved since
// the first sample.
struct Approach {
  int pan = 0, tilt = 0;
};

class ApproachHistory {
 public:
  // `step`: size of the mount's counts [rad]. A motion of less than a count and a half is ignored
  // as noise, because an axis at rest may report the average of two neighbouring counts.
  explicit ApproachHistory(const PanTilt& step) : step_(step) {}
  void set_step(const PanTilt& step) { step_ = step; }

  // Adds the reported angles [rad]. Call in order of time. Changes of direction older than ten
  // seconds are forgotten, except the last one, which still applies.
  void add(double time_s, const PanTilt& reported);
  void clear();

  // The approach at this instant; after the newest sample, the approach at that sample.
  Approach at(double time_s) const;
  Approach newest() const { return changes_.empty() ? Approach{} : changes_.back().approach; }

 private:
  struct Axis {
    bool known = false;
    double extreme_rad = 0.0;  // the furthest point reached in the present direction
    int sign = 0;
    // Returns whether the sign has changed.
    bool add(double angle_rad, double step_rad);
  };
  struct Change {
    double time_s;
    Approach approach;  // applies from time_s on
  };

  PanTilt step_;
  Axis pan_, tilt_;
  std::deque<Change> changes_;
};

}  // namespace ols::mount
