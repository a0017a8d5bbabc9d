#include "edge/mount/driven/position_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edge/mount/driven/position_intake.h"

namespace ols::mount {
namespace {

using Kind = OrderedMotion::Kind;

constexpr double kComesToRest_s = 1.6;  // after a stop, as positions show it
constexpr double kAfterOrder_s = 10.0;  // a later motion has nothing to do with the last order
constexpr double kTravel_s = 2.0;       // of motion in one direction, before it is judged
constexpr double kTurns_s = 0.5;        // of motion in one direction, before it counts
constexpr double kContrary_s = 0.7;     // the same if it goes the wrong way
constexpr double kTravel_rad = radians(3.0);
constexpr double kTravelShare = 0.1;  // of the ordered travel that must be seen
constexpr double kWay_s = 4.0;        // until a move to a position is judged

int sign_of(double rate_rad_s) { return rate_rad_s > 0.0 ? 1 : rate_rad_s < 0.0 ? -1 : 0; }

bool within(const AngleBox& box, const PanTilt& angles, double most_rad) {
  const auto is = [most_rad](double angle_rad, double min_rad, double max_rad) {
    return angle_rad > min_rad - most_rad && angle_rad < max_rad + most_rad;
  };
  return is(angles.pan_rad, box.pan_min_rad, box.pan_max_rad) &&
         is(angles.tilt_rad, box.tilt_min_rad, box.tilt_max_rad);
}

}  // namespace

// A mount that has not moved since an earlier order is judged from that order on: goals may follow
// each other faster than a move is judged.
void PositionWatch::motion_ordered(const RecentPositions& positions, const OrderedMotion& ordered) {
  rest_.reset();
  may_be_in_.reset();
  unstopped_.forget();
  if (ordered.kind == Kind::kVelocity) return way_.reset();
  if (positions.empty()) return;
  const PanTilt& at = positions.newest();
  if (!way_ || distance(at, way_->from) > positions.least_motion_rad())
    way_ = Way{ordered.ordered_s, at};
}

void PositionWatch::lost(const RecentPositions& positions, const OrderedMotion& ordered,
                         bool answered, double lasts_s) {
  was_lost_ = true;
  if (!answered) {  // whether the motion was carried out is unknown
    rest_.reset();
    may_be_in_.reset();
  } else if (ordered.kind != Kind::kNone) {
    rest_.reset();
    if (positions.empty()) return;
    const PanTilt& at = positions.newest();
    const double runs_s = lasts_s + kComesToRest_s;
    const PanTilt end{at.pan_rad + ordered.rate.pan_rad * runs_s,
                      at.tilt_rad + ordered.rate.tilt_rad * runs_s};
    may_be_in_ = spanned(at, ordered.kind == Kind::kAbsolute ? ordered.place : end);
  } else if (!rest_ && !positions.empty() && !positions.move()) {
    rest_ = positions.newest();
  }
}

Demand PositionWatch::judge(const RecentPositions& positions, const OrderedMotion& ordered,
                            PictureWatch& pictures) {
  const Case is{positions, ordered, pictures};
  const PanTilt& at = positions.newest();
  const Demand pan = add_travel(pan_travel_, ordered.rate.pan_rad, at.pan_rad, is);
  const Demand tilt = add_travel(tilt_travel_, ordered.rate.tilt_rad, at.tilt_rad, is);
  const Demand way = judge_way(is);
  judge_place_after_loss(positions);
  return std::max({pan, tilt, way, judge_rest(positions, ordered)});
}

Demand PositionWatch::add_travel(Travel& travel, double rate_rad_s, double angle_rad,
                                 const Case& is) {
  const double now_s = is.positions.newest_s();
  const int sign = sign_of(rate_rad_s);
  if (sign != travel.sign) travel = {now_s, 0.0, angle_rad, sign, now_s};
  if (sign == 0) return Demand::kNothing;
  if (now_s - travel.since_s < kTurns_s) {
    travel.from_rad = angle_rad;
    return Demand::kNothing;
  }
  travel.ordered_rad += rate_rad_s * is.positions.last_interval_s();
  const double went_rad = (angle_rad - travel.from_rad) * sign;
  const double least_s = went_rad < 0.0 ? kContrary_s : kTravel_s;
  const double ordered_rad = std::abs(travel.ordered_rad);
  if (now_s - travel.since_s < least_s || ordered_rad < kTravel_rad) return Demand::kNothing;
  const double begun_s = travel.begun_s;
  travel = {now_s, 0.0, angle_rad, sign, begun_s};
  distrusted_ = went_rad < kTravelShare * ordered_rad;
  if (distrusted_) return ignores_order(now_s);
  is.pictures.judge_followed(begun_s, ordered_rad, is.positions, is.ordered, now_s);
  return Demand::kNothing;
}

// Some mounts accept a move to a position and stay, or report that they stay.
Demand PositionWatch::judge_way(const Case& is) {
  const double now_s = is.positions.newest_s();
  if (!way_ || now_s - way_->since_s < kWay_s) return Demand::kNothing;
  const Way way = *std::exchange(way_, std::nullopt);
  const double way_rad = distance(is.ordered.place, way.from);
  if (way_rad < 2.0 * is.positions.least_motion_rad()) return Demand::kNothing;
  const double went_rad = way_rad - distance(is.ordered.place, is.positions.newest());
  // Slow mounts are on the way for minutes.
  distrusted_ = went_rad < is.positions.least_motion_rad();
  if (distrusted_) return ignores_order(now_s);
  is.pictures.judge_followed(way.since_s, went_rad, is.positions, is.ordered, now_s);
  return Demand::kNothing;
}

Demand PositionWatch::ignores_order(double now_s) {
  ignored_.at(now_s);
  ++counters_.orders_ignored;
  return Demand::kGiveUp;
}

// A mount that has started anew is in its home position, or on the way to it.
void PositionWatch::judge_place_after_loss(const RecentPositions& positions) {
  const double now_s = positions.newest_s();
  if (std::exchange(was_lost_, false)) {
    auto box = std::exchange(may_be_in_, std::nullopt);
    if (!box && rest_) box = spanned(*rest_, *rest_);
    if (box && !within(*box, positions.newest(), 2.0 * positions.least_motion_rad())) {
      displaced_ = true;
      displaced_since_s_ = now_s;
      moved_unconnected_.at(now_s);
      rest_.reset();
      ++counters_.moved_unconnected;
    }
  }
  if (positions.move()) displaced_since_s_ = now_s;
  if (now_s - displaced_since_s_ > kComesToRest_s) displaced_ = false;
}

// Without an order, the mount must stay where it came to rest.
Demand PositionWatch::judge_rest(const RecentPositions& positions, const OrderedMotion& ordered) {
  if (ordered.kind != Kind::kNone || !ordered.rests_since_s) return Demand::kNothing;
  const double now_s = positions.newest_s();
  const double rested_s = now_s - *ordered.rests_since_s;
  const double left_rad = rest_ ? distance(positions.newest(), *rest_) : 0.0;
  const bool left = left_rad > 2.0 * positions.least_motion_rad();
  if (!left && !(positions.move() && rested_s > kComesToRest_s)) {
    if (!rest_ && rested_s > OrderedMotion::kRested_s) rest_ = positions.newest();
    return Demand::kNothing;
  }
  const bool after_order =
      !rest_ && now_s - ordered.ordered_s < kAfterOrder_s && ordered.ordered_s > 0.0;
  (after_order ? unstopped_ : unordered_).at(now_s);
  if (after_order) return Demand::kNothing;
  if (left) {
    ++counters_.unordered_motions;
    rest_ = positions.newest();
  }
  return Demand::kStop;
}

}  // namespace ols::mount
