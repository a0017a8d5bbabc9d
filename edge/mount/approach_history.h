// From which side each axis came to its present angle, which decides where its backlash leaves it.
// Pure.
#pragma once

#include <deque>

#include "geometry/kinematic_chain.h"

namespace ols::mount {

// 1 or -1: the sign of the last motion in counts; 0: it has not moved since the samples began.
struct Approach {
  int pan = 0, tilt = 0;
};

class ApproachHistory {
 public:
  // `step`: of the unit's counters [rad]. A motion of less than a count and a half is noise: so
  // much appears when a standing axis reports averages of two counts.
  explicit ApproachHistory(const PanTilt& step) : step_(step) {}
  void set_step(const PanTilt& step) { step_ = step; }

  // In time order. Changes older than ten seconds are forgotten, except the last one, which is
  // still in force.
  void add(double time_s, const PanTilt& reported);
  void clear();

  // The approach in force at this instant; after the newest sample, the newest one.
  Approach at(double time_s) const;

 private:
  struct Axis {
    bool known = false;
    double extreme_rad = 0.0;  // the furthest point of the present direction
    int sign = 0;
    // Whether the sign changed.
    bool add(double angle_rad, double step_rad);
  };
  struct Change {
    double time_s;
    Approach approach;  // from then on
  };

  PanTilt step_;
  Axis pan_, tilt_;
  std::deque<Change> changes_;
};

}  // namespace ols::mount
