#include "edge/mount/driven/picture_watch.h"

#include <cmath>
#include <utility>

#include "edge/mount/driven/position_intake.h"

namespace ols::mount {
namespace {

constexpr double kPictureLate_s = 1.0;   // at most, in relation to the orders
constexpr double kPositionLate_s = 1.0;  // at most, in relation to the pictures
constexpr double kShownShare = 0.1;      // of the reported travel that the pictures must show

}  // namespace

void PictureWatch::motion_ordered() {
  rested_ = false;
  moved_since_s_.reset();
  unstopped_.forget();
}

// The pictures of an own motion come late, and a camera may report a position before it is there.
// Therefore, only a motion after a rest in the pictures is one without an order.
Demand PictureWatch::see(const SeenTurn& turn, const RecentPositions& positions,
                         const OrderedMotion& ordered) {
  picture_.add(turn, positions.newest().tilt_rad);
  const auto& still_since_s = ordered.still_since_s();
  if (!still_since_s) return Demand::kNothing;
  const auto is = picture_.judge(*still_since_s + OrderedMotion::kRested_s);
  const bool moved = std::exchange(moves_, is == PictureMotion::Is::kMoving);
  const Demand demand = moves_ ? take_motion(turn.to_s, moved, ordered.kind) : Demand::kNothing;
  judge_positions(turn.to_s, positions);
  if (is == PictureMotion::Is::kAtRest) {
    rested_ = true;
    rest_ = positions.newest();
  }
  return demand;
}

Demand PictureWatch::take_motion(double time_s, bool moved_before, OrderedMotion::Kind ordered) {
  if (!rested_ && ordered == OrderedMotion::Kind::kAbsolute) return Demand::kNothing;
  (rested_ ? moved_ : unstopped_).at(time_s);
  if (rested_ && !moved_before) {
    ++unordered_motions_;
    moved_since_s_ = time_s;
  }
  return Demand::kStop;
}

// Positions that do not show a motion of the pictures are wrong. They may be late.
void PictureWatch::judge_positions(double time_s, const RecentPositions& positions) {
  if (!moved_since_s_ || time_s - *moved_since_s_ < kPositionLate_s) return;
  moved_since_s_.reset();
  if (distance(positions.newest(), rest_) < positions.least_motion_rad()) frozen_.at(time_s);
}

// Positions that follow an order although the pictures stand are wrong, or all corners of the
// pictures belong to burnt-in text: this is told, and ends nothing. The pictures may be late.
void PictureWatch::judge_followed(double since_s, double way_rad, const RecentPositions& positions,
                                  const OrderedMotion& ordered, double now_s) {
  // The mount may be there in a second.
  const bool at_once = ordered.kind == OrderedMotion::Kind::kAbsolute;
  const double seen_rad = way_rad * std::cos(positions.newest().tilt_rad);
  if (picture_.stood(since_s + (at_once ? 0.0 : kPictureLate_s), kShownShare * seen_rad)) {
    contradicted_.at(now_s);
  } else {
    frozen_.forget();
  }
}

}  // namespace ols::mount
