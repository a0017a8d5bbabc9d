// Judges by the pictures whether a mount moves without an order, and whether its reported positions
// are true. Pure.
#pragma once

#include <cstdint>
#include <optional>

#include "edge/mount/driven/ordered_motion.h"
#include "edge/mount/driven/picture_motion.h"
#include "edge/mount/driven/recent_positions.h"

namespace ols::mount {

class PictureWatch {
 public:
  void connected() { frozen_.forget(); }
  void motion_ordered();
  // Takes a turn of the camera between two pictures.
  Demand see(const SeenTurn& turn, const RecentPositions& positions, const OrderedMotion& ordered);
  // Judges positions that followed an order over `way_rad` since then.
  void judge_followed(double since_s, double way_rad, const RecentPositions& positions,
                      const OrderedMotion& ordered, double now_s);

  // The reported positions stayed while the pictures moved, within the last half minute.
  bool frozen(double now_s) const { return frozen_.holds(now_s); }
  // The same, or the pictures stayed while the positions moved.
  bool contradicted(double now_s) const { return frozen(now_s) || contradicted_.holds(now_s); }
  bool unordered(double now_s) const { return moved_.holds(now_s); }
  bool unstopped(double now_s) const { return unstopped_.holds(now_s); }
  std::uint64_t unordered_motions() const { return unordered_motions_; }

 private:
  Demand take_motion(double time_s, bool moved_before, OrderedMotion::Kind ordered);
  void judge_positions(double time_s, const RecentPositions& positions);

  PictureMotion picture_;
  bool moves_ = false;
  bool rested_ = false;  // the picture was at rest since the last order of a motion
  PanTilt rest_;         // the reported position at that time
  Sighted moved_, unstopped_, frozen_, contradicted_;
  // Begin of a motion without an order for which the positions are not judged yet.
  std::optional<double> moved_since_s_;
  std::uint64_t unordered_motions_ = 0;
};

}  // namespace ols::mount
