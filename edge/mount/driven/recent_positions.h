// The positions that a mount reported during the last 0.6 s, and whether they show a motion. Pure.
#pragma once

#include <deque>

#include "geometry/kinematic_chain.h"

namespace ols::mount {

class RecentPositions {
 public:
  // `sd_rad`: 1-sigma of a position.
  explicit RecentPositions(double sd_rad);

  void add(const PanTilt& angles, double time_s);
  void clear() { seen_.clear(); }

  bool empty() const { return seen_.empty(); }
  // The following three require a position.
  const PanTilt& newest() const { return seen_.back().angles; }
  double newest_s() const { return seen_.back().time_s; }
  double last_interval_s() const;  // between the newest two; 0 if there is only one

  double least_motion_rad() const { return least_motion_rad_; }  // a smaller one may be scatter
  bool move() const { return move_since(-1e9); }
  bool move_since(double time_s) const;

 private:
  struct Seen {
    double time_s;
    PanTilt angles;
  };
  double least_motion_rad_;
  std::deque<Seen> seen_;
};

}  // namespace ols::mount
