// Judges by the reported positions whether a mount does what was ordered: whether it follows,
// stops, stays at rest, and is after a lost connection where it may be. Pure.
#pragma once

#include <cstdint>
#include <optional>

#include "edge/mount/driven/ordered_motion.h"
#include "edge/mount/driven/picture_watch.h"
#include "edge/mount/driven/recent_positions.h"
#include "edge/mount/keep_out.h"

namespace ols::mount {

class PositionWatch {
 public:
  // Call after the mount has accepted a motion or a stop, with `ordered` as it is then.
  void motion_ordered(const RecentPositions& positions, const OrderedMotion& ordered);
  void stop_ordered() { way_.reset(); }
  // `answered`: the last order of a motion was. `lasts_s`: time for which the mount may go on
  // moving without a connection.
  void lost(const RecentPositions& positions, const OrderedMotion& ordered, bool answered,
            double lasts_s);
  // Judges the newest position. Positions that followed an order are then judged by `pictures`.
  Demand judge(const RecentPositions& positions, const OrderedMotion& ordered,
               PictureWatch& pictures);

  // The positions have not followed an order, nor any since then.
  bool distrusted() const { return distrusted_; }
  // The mount has moved without a connection, and has not come to rest since.
  bool displaced() const { return displaced_; }
  // Within the last half minute, the mount ignored an order, did not stop, moved without an order,
  // had moved without a connection.
  bool ignored(double now_s) const { return distrusted_ || ignored_.holds(now_s); }
  bool unstopped(double now_s) const { return unstopped_.holds(now_s); }
  bool unordered(double now_s) const { return unordered_.holds(now_s); }
  bool moved_unconnected(double now_s) const { return moved_unconnected_.holds(now_s); }

  struct Counters {
    std::uint64_t unordered_motions = 0, orders_ignored = 0, moved_unconnected = 0;
  };
  const Counters& counters() const { return counters_; }

 private:
  // What is judged, and what judges with it.
  struct Case {
    const RecentPositions& positions;
    const OrderedMotion& ordered;
    PictureWatch& pictures;
  };
  // The ordered and the reported travel of one axis in the present direction.
  struct Travel {
    double since_s = 0.0, ordered_rad = 0.0, from_rad = 0.0;
    int sign = 0;
    double begun_s = 0.0;  // of the motion in this direction; since_s is that of its last part
  };
  // An ordered move to a position that is not judged yet.
  struct Way {
    double since_s;
    PanTilt from;
  };

  Demand add_travel(Travel& travel, double rate_rad_s, double angle_rad, const Case& is);
  Demand judge_way(const Case& is);
  Demand ignores_order(double now_s);
  void judge_place_after_loss(const RecentPositions& positions);
  Demand judge_rest(const RecentPositions& positions, const OrderedMotion& ordered);

  Travel pan_travel_, tilt_travel_;
  std::optional<Way> way_;
  bool distrusted_ = false;
  std::optional<PanTilt> rest_;  // position at which the mount came to rest
  // Where the mount can be by its last order; set when the connection is lost in motion.
  std::optional<AngleBox> may_be_in_;
  bool was_lost_ = false;  // and no position was reported since
  bool displaced_ = false;
  double displaced_since_s_ = -1e9;  // or since when it last moved
  Sighted ignored_, unstopped_, unordered_, moved_unconnected_;
  Counters counters_;
};

}  // namespace ols::mount
