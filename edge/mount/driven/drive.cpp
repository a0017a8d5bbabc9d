#include "edge/mount/driven/drive.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "conditions/alarms.h"
#include "geometry/angles.h"

namespace ols::mount {
namespace {

constexpr double kWindow_s = 0.6;  // over which reported positions show a motion
constexpr double kLeastMotion_rad = radians(0.2);
constexpr double kStopAgain_s = 0.4;    // until a stop that changed nothing is repeated
constexpr double kBrakes_s = 0.2;       // after a stop: the mount may still be braking
constexpr double kComesToRest_s = 1.6;  // after a stop, with kWindow_s
constexpr double kRested_s = 3.0;       // after a stop: from then on the mount must not move
constexpr double kAfterOrder_s = 10.0;  // a later motion has nothing to do with the last order
constexpr double kOldPosition_s = 1.0;  // with an older position there is no motion
constexpr double kAhead_s = 0.5;        // longest extrapolation by the ordered rate
constexpr double kTravel_s = 2.0;       // of motion in one direction, before it is judged
constexpr double kTurns_s = 0.5;        // of motion in one direction, before it counts
constexpr double kContrary_s = 0.7;     // the same if it goes the wrong way
constexpr double kTravel_rad = radians(3.0);
constexpr double kTravelShare = 0.1;  // of the ordered travel that must be seen
constexpr double kRefused_s = 10.0;   // without motion, after ignored orders
constexpr double kAlarm_s = 30.0;     // an alarm stays after its cause was last seen
constexpr double kRateStep_rad_s = radians(0.1);
constexpr double kRateShare = 0.05;   // a smaller change of rate waits for the renewal
constexpr double kRenew = 1.0 / 3.0;  // of the lease: a motion is then renewed
constexpr double kLastPiece_rad = radians(2.0);
constexpr double kWay_s = 4.0;            // until a move to a position is judged
constexpr double kAbsoluteAgain_s = 5.0;  // a place that was not reached is ordered again
constexpr double kPictureLate_s = 1.0;    // at most, in relation to the orders

double position_of(const AxisScale& scale, double angle_rad) {
  return (angle_rad - scale.zero_rad) / scale.per_unit_rad;
}
double angle_of(const AxisScale& scale, double position) {
  return scale.zero_rad + scale.per_unit_rad * position;
}

// The travel of an axis, as narrow as configuration and camera make it.
void narrow(double& min_rad, double& max_rad, const AxisScale& scale, const Span& span) {
  const auto [low, high] = std::minmax({angle_of(scale, span.min), angle_of(scale, span.max)});
  min_rad = std::max(min_rad, low);
  max_rad = std::min(max_rad, high);
}

double velocity_of(const AxisScale& scale, double rate_rad_s, const Span& span) {
  return std::clamp(rate_rad_s / scale.speed_per_unit_rad, span.min, span.max);
}

double fastest(const PanTilt& rate) {
  return std::max(std::abs(rate.pan_rad), std::abs(rate.tilt_rad));
}

bool differs(const PanTilt& a, const PanTilt& b) {
  return distance(a, b) > std::max(kRateStep_rad_s, kRateShare * fastest(a)) ||
         (fastest(a) == 0.0) != (fastest(b) == 0.0);
}

}  // namespace

void Drive::connected(const Moves& moves) {
  offered_ = moves;
  limits_ = config_.limits;
  limits_.count = {kVirtualCount_rad, kVirtualCount_rad};
  if (moves.absolute) {
    narrow(limits_.pan_min_rad, limits_.pan_max_rad, config_.pan, moves.absolute->x);
    narrow(limits_.tilt_min_rad, limits_.tilt_max_rad, config_.tilt, moves.absolute->y);
  }
  stop_wanted_ = true;
  stops_ = 0;
  intake_.restart();
  seen_.clear();
  frozen_s_.reset();
}

void Drive::lost() {
  goal_.reset();
  was_lost_ = true;
  if (std::exchange(is_sent_, false)) {  // whether the motion was carried out is unknown
    rest_.reset();
    may_be_in_.reset();
  } else if (motion_ != Motion::kNone) {
    rest_.reset();
    if (!seen_.empty()) may_be_in_ = spanned(seen_.back().angles, end_of_motion());
  } else if (!rest_ && !seen_.empty() && !moves()) {
    rest_ = seen_.back().angles;
  }
  seen_.clear();
}

// Where the mount comes to rest if nothing more is ordered and it keeps the time-out.
PanTilt Drive::end_of_motion() const {
  if (motion_ == Motion::kAbsolute) return absolute_;
  const PanTilt& at = seen_.back().angles;
  const double lasts_s = std::max(config_.lease_s, offered_.least_lease_s) + kComesToRest_s;
  return {at.pan_rad + rate_.pan_rad * lasts_s, at.tilt_rad + rate_.tilt_rad * lasts_s};
}

void Drive::set_goal(const std::optional<Goal>& goal) { goal_ = emergency_ ? std::nullopt : goal; }

void Drive::emergency_halt() {
  emergency_ = stop_wanted_ = true;
  stops_ = 0;
  goal_.reset();
  ++counters_.emergencies;
}

std::optional<double> Drive::last_position_s() const {
  return seen_.empty() ? std::nullopt : std::optional(seen_.back().time_s);
}

double Drive::seen_motion_rad() const {
  return std::max(kLeastMotion_rad, 4.0 * config_.positions.sd_rad);
}

bool Drive::moves_since(double time_s) const {
  return std::ranges::any_of(seen_, [&](const Seen& seen) {
    return seen.time_s > time_s && distance(seen.angles, seen_.back().angles) > seen_motion_rad();
  });
}

bool Drive::stop_is_due(double now_s) const {
  const bool again = now_s - stop_s_ >= kStopAgain_s;
  if (stop_wanted_ && (stops_ == 0 || again)) return true;
  return motion_ == Motion::kNone && again && moves_since(stop_s_ + kBrakes_s);
}

// Some cameras obey only one of the two.
Order Drive::stop_order() const {
  const bool by_velocity = stops_ % 2 == 1 && offered_.continuous;
  return {by_velocity ? Act::kVelocity : Act::kStop, {}};
}

Order Drive::next(double now_s) {
  if (stop_is_due(now_s)) return stop_order();
  const bool old = seen_.empty() || now_s - seen_.back().time_s > kOldPosition_s;
  if (motion_ != Motion::kNone && old && now_s - ordered_s_ > kOldPosition_s) {
    stop_wanted_ = true;
    stops_ = 0;
    return stop_order();
  }
  if (!stop_wanted_ && !old) {
    const Order order = motion(now_s);
    is_sent_ = order.act == Act::kVelocity || order.act == Act::kAbsolute;
    if (order.act != Act::kWait) return order;
  }
  return {now_s - asked_s_ >= config_.poll_s ? Act::kStatus : Act::kWait, {}};
}

PanTilt Drive::angles_now(double now_s) const {
  const Seen& newest = seen_.back();
  if (motion_ != Motion::kVelocity) return newest.angles;
  const double ahead_s = std::clamp(now_s - newest.time_s, 0.0, kAhead_s);
  return {newest.angles.pan_rad + rate_.pan_rad * ahead_s,
          newest.angles.tilt_rad + rate_.tilt_rad * ahead_s};
}

// nullopt: no motion is wanted or permitted.
std::optional<PanTilt> Drive::wanted_rate(double now_s) const {
  if (!goal_ || now_s < refused_until_s_ || !offered_.continuous) return std::nullopt;
  Goal goal = *goal_;
  goal.rests = false;  // proportional: answers are too late for the shortest braking
  const PanTilt now = angles_now(now_s);
  const auto command = ptu::servo_step(config_.servo, limits_, goal, now, now_s, rate_);
  if (!command) return std::nullopt;
  const auto rate = [&](double to_rad, double from_rad, double speed_rad_s, double goal_rad_s) {
    const double way_rad = to_rad - from_rad;
    const bool there = goal_rad_s == 0.0 && std::abs(way_rad) < config_.positions.sd_rad;
    return there ? 0.0 : std::copysign(speed_rad_s, way_rad);
  };
  return PanTilt{
      rate(command->position.pan_rad, now.pan_rad, command->speed.pan_rad, goal.rate.pan_rad),
      rate(command->position.tilt_rad, now.tilt_rad, command->speed.tilt_rad, goal.rate.tilt_rad)};
}

// A move to a goal at rest that is near enough to need no lease.
std::optional<Order> Drive::last_piece(double now_s) const {
  if (!goal_ || !goal_->rests || goal_->rate_only || !offered_.absolute) return std::nullopt;
  if (now_s > goal_->valid_until_s || now_s < refused_until_s_) return std::nullopt;
  const PanTilt& to = goal_->angles;
  const PanTilt& at = seen_.back().angles;
  if (offered_.continuous && distance(to, at) > kLastPiece_rad) return std::nullopt;
  const AngleBox travel = mount::travel(limits_);
  if (to.pan_rad < travel.pan_min_rad || to.pan_rad > travel.pan_max_rad ||
      to.tilt_rad < travel.tilt_min_rad || to.tilt_rad > travel.tilt_max_rad ||
      blocked(limits_.keep_out, spanned(to, at)))
    return std::nullopt;
  const bool ordered = motion_ == Motion::kAbsolute && distance(absolute_, to) < intake_.sd_rad();
  const bool there = distance(to, at) < 2.0 * intake_.sd_rad();
  if (ordered ? there || now_s - ordered_s_ < kAbsoluteAgain_s : there && fastest(rate_) == 0.0)
    return Order{};
  return Order{Act::kAbsolute,
               {position_of(config_.pan, to.pan_rad), position_of(config_.tilt, to.tilt_rad)}};
}

Order Drive::motion(double now_s) {
  if (const auto order = last_piece(now_s)) return *order;
  const auto rate = wanted_rate(now_s);
  if (!rate || fastest(*rate) == 0.0) {
    if (motion_ == Motion::kNone) return {};
    stop_wanted_ = true;
    stops_ = 0;
    return stop_order();
  }
  const bool new_position = seen_.back().time_s > moved_for_s_;
  const bool expires = now_s - ordered_s_ > kRenew * config_.lease_s;
  const bool other = motion_ != Motion::kVelocity || differs(*rate, rate_);
  if (!expires && !(other && new_position)) return {};
  return {Act::kVelocity,
          {velocity_of(config_.pan, rate->pan_rad, offered_.continuous->x),
           velocity_of(config_.tilt, rate->tilt_rad, offered_.continuous->y)}};
}

void Drive::done(const Order& order, double now_s) {
  is_sent_ = false;
  const bool stands_for_stop =
      order.act == Act::kVelocity && order.vector.x == 0.0 && order.vector.y == 0.0;
  if (order.act == Act::kStop || stands_for_stop) {
    if (stops_++ > 0) ++counters_.stops_repeated;
    stop_s_ = now_s;
    stop_wanted_ = false;
    motion_ = Motion::kNone;
    way_.reset();
    rate_ = {};
    intake_.ordered(rate_, now_s);
    if (!rests_since_s_) rests_since_s_ = now_s;
    return;
  }
  if (order.act != Act::kVelocity && order.act != Act::kAbsolute) return;
  rests_since_s_.reset();
  arrived_s_.reset();
  rest_.reset();
  unstopped_s_.reset();
  may_be_in_.reset();
  picture_rested_ = false;
  picture_moved_since_s_.reset();
  stops_ = 0;
  if (order.act == Act::kAbsolute) begin_way(now_s);
  if (order.act == Act::kVelocity) way_.reset();
  ordered_s_ = now_s;
  moved_for_s_ = seen_.empty() ? 0.0 : seen_.back().time_s;
  if (order.act == Act::kVelocity) {
    motion_ = Motion::kVelocity;
    rate_ = {order.vector.x * config_.pan.speed_per_unit_rad,
             order.vector.y * config_.tilt.speed_per_unit_rad};
  } else {
    motion_ = Motion::kAbsolute;
    rate_ = {};
    absolute_ = {angle_of(config_.pan, order.vector.x), angle_of(config_.tilt, order.vector.y)};
  }
  intake_.ordered(motion_ == Motion::kVelocity ? std::optional(rate_) : std::nullopt, now_s);
}

// A refused motion may be under way all the same.
void Drive::failed(const Order& order, double now_s) {
  is_sent_ = false;
  if (order.act == Act::kStop) {
    ++stops_;
    stop_s_ = now_s;
  }
  if (order.act != Act::kVelocity && order.act != Act::kAbsolute) return;
  stop_wanted_ = true;
  stops_ = 0;
  refused_until_s_ = now_s + kRefused_s;
}

void Drive::take(const Vector& position, double sent_s, double answered_s) {
  asked_s_ = sent_s;
  const PanTilt angles{angle_of(config_.pan, position.x), angle_of(config_.tilt, position.y)};
  const double now_s = 0.5 * (sent_s + answered_s) - config_.positions.delay_s;
  const bool goes = motion_ == Motion::kAbsolute && distance(absolute_, angles) > seen_motion_rad();
  intake_.add(angles, sent_s, answered_s, goes ? config_.servo.max_speed_rad_s : fastest(rate_));
  seen_.push_back({now_s, angles});
  while (now_s - seen_.front().time_s > kWindow_s) seen_.pop_front();
  if (motion_ == Motion::kAbsolute && !goes && !arrived_s_) arrived_s_ = now_s;
  add_travel(pan_travel_, rate_.pan_rad, angles.pan_rad, now_s);
  add_travel(tilt_travel_, rate_.tilt_rad, angles.tilt_rad, now_s);
  judge_way(angles, now_s);
  judge_place_after_loss(angles, now_s);
  judge_rest(now_s);
}

void Drive::add_travel(Travel& travel, double rate_rad_s, double angle_rad, double now_s) {
  const int sign = rate_rad_s > 0.0 ? 1 : rate_rad_s < 0.0 ? -1 : 0;
  if (sign != travel.sign) travel = {now_s, 0.0, angle_rad, sign, now_s};
  if (sign == 0 || seen_.size() < 2) return;
  if (now_s - travel.since_s < kTurns_s) {
    travel.from_rad = angle_rad;
    return;
  }
  travel.ordered_rad += rate_rad_s * (now_s - seen_[seen_.size() - 2].time_s);
  const bool contrary = (angle_rad - travel.from_rad) * travel.ordered_rad < 0.0;
  const double least_s = contrary ? kContrary_s : kTravel_s;
  if (now_s - travel.since_s < least_s || std::abs(travel.ordered_rad) < kTravel_rad) return;
  distrusted_ = false;
  judge_travel(travel, angle_rad, now_s);
  travel = {now_s, 0.0, angle_rad, sign, travel.begun_s};
}

void Drive::judge_travel(const Travel& travel, double angle_rad, double now_s) {
  if ((angle_rad - travel.from_rad) / travel.ordered_rad >= kTravelShare)
    return judge_pictures_of_motion(travel.begun_s, std::abs(travel.ordered_rad), now_s);
  distrusted_ = true;
  ignored_s_ = now_s;
  give_up_motion(now_s);
}

void Drive::give_up_motion(double now_s) {
  ++counters_.orders_ignored;
  refused_until_s_ = now_s + kRefused_s;
  stop_wanted_ = true;
  stops_ = 0;
}

// A mount that has not moved since an earlier order is judged from that order on: goals may follow
// each other faster than a move is judged.
void Drive::begin_way(double now_s) {
  if (seen_.empty()) return;
  const PanTilt& at = seen_.back().angles;
  if (!way_ || distance(at, way_->from) > seen_motion_rad()) way_ = Way{now_s, at};
}

// Some mounts accept a move to a position and stay, or report that they stay.
void Drive::judge_way(const PanTilt& angles, double now_s) {
  if (!way_ || now_s - way_->since_s < kWay_s) return;
  const Way way = *std::exchange(way_, std::nullopt);
  const double way_rad = distance(absolute_, way.from);
  if (way_rad < 2.0 * seen_motion_rad()) return;
  const double went_rad = way_rad - distance(absolute_, angles);
  distrusted_ = went_rad < seen_motion_rad();  // slow mounts are on the way for minutes
  if (!distrusted_) return judge_pictures_of_motion(way.since_s, went_rad, now_s);
  ignored_s_ = now_s;
  give_up_motion(now_s);
}

// Positions that follow an order although the pictures stand are wrong, or all corners of the
// pictures belong to burnt-in text: this is told, and ends nothing. The pictures may be late.
void Drive::judge_pictures_of_motion(double since_s, double way_rad, double now_s) {
  const bool at_once = motion_ == Motion::kAbsolute;  // and the mount may be there in a second
  const double seen_rad = way_rad * std::cos(seen_.back().angles.tilt_rad);
  if (picture_.stood(since_s + (at_once ? 0.0 : kPictureLate_s), kTravelShare * seen_rad)) {
    contradicted_s_ = now_s;
  } else {
    frozen_s_.reset();
  }
}

// A mount that has started anew is in its home position, or on the way to it.
void Drive::judge_place_after_loss(const PanTilt& angles, double now_s) {
  const double most_rad = 2.0 * seen_motion_rad();
  const auto within = [most_rad](double angle_rad, double min_rad, double max_rad) {
    return angle_rad > min_rad - most_rad && angle_rad < max_rad + most_rad;
  };
  if (std::exchange(was_lost_, false)) {
    const auto box = may_be_in_ ? may_be_in_
                     : rest_    ? std::optional(spanned(*rest_, *rest_))
                                : std::nullopt;
    may_be_in_.reset();
    if (box && !(within(angles.pan_rad, box->pan_min_rad, box->pan_max_rad) &&
                 within(angles.tilt_rad, box->tilt_min_rad, box->tilt_max_rad))) {
      displaced_ = true;
      displaced_s_ = displaced_since_s_ = now_s;
      rest_.reset();
      ++counters_.moved_unconnected;
    }
  }
  if (moves()) displaced_since_s_ = now_s;
  if (now_s - displaced_since_s_ > kComesToRest_s) displaced_ = false;
}

// Without an order, the mount must stay where it came to rest.
void Drive::judge_rest(double now_s) {
  if (motion_ != Motion::kNone || !rests_since_s_) return;
  const double rested_s = now_s - *rests_since_s_;
  const bool left = rest_ && distance(seen_.back().angles, *rest_) > 2.0 * seen_motion_rad();
  if (!left && !(moves() && rested_s > kComesToRest_s)) {
    if (!rest_ && rested_s > kRested_s) rest_ = seen_.back().angles;
    return;
  }
  const bool after_order = !rest_ && now_s - ordered_s_ < kAfterOrder_s && ordered_s_ > 0.0;
  (after_order ? unstopped_s_ : unordered_s_) = now_s;
  if (after_order) return;
  if (left) ++counters_.unordered_motions;
  if (left) rest_ = seen_.back().angles;
  stop_wanted_ = true;
}

// The pictures of an own motion come late, and a camera may report a position before it is there.
// Therefore, only a motion after a rest in the pictures is one without an order.
void Drive::see(const SeenTurn& turn) {
  if (seen_.empty()) return;
  picture_.add(turn, seen_.back().angles.tilt_rad);
  const auto& still_since_s = motion_ == Motion::kNone ? rests_since_s_ : arrived_s_;
  if (!still_since_s) return;
  const auto is = picture_.judge(*still_since_s + kRested_s);
  const bool moved = std::exchange(picture_moves_, is == PictureMotion::Is::kMoving);
  if (picture_moves_) move_in_picture(turn.to_s, moved);
  judge_positions(turn.to_s);
  if (is != PictureMotion::Is::kAtRest) return;
  picture_rested_ = true;
  picture_rest_ = seen_.back().angles;
}

void Drive::move_in_picture(double time_s, bool moved_before) {
  if (!picture_rested_ && motion_ == Motion::kAbsolute) return;
  stop_wanted_ = true;
  (picture_rested_ ? picture_moved_s_ : unstopped_s_) = time_s;
  if (!picture_rested_ || moved_before) return;
  ++counters_.unordered_in_picture;
  picture_moved_since_s_ = time_s;
}

// Positions that do not show a motion of the pictures are wrong. They may be late.
void Drive::judge_positions(double time_s) {
  if (!picture_moved_since_s_ || time_s - *picture_moved_since_s_ < kOldPosition_s) return;
  picture_moved_since_s_.reset();
  if (distance(seen_.back().angles, picture_rest_) < seen_motion_rad()) frozen_s_ = time_s;
}

std::vector<AngleSample> Drive::take_samples() {
  auto samples = intake_.take();
  const bool frozen = frozen_s_ && !seen_.empty() && seen_.back().time_s - *frozen_s_ < kAlarm_s;
  if (distrusted_ || frozen || displaced_) samples.clear();
  return samples;
}

std::vector<Alarm> Drive::alarms(double now_s) const {
  std::vector<Alarm> alarms;
  const auto holds = [now_s](const std::optional<double>& seen_s) {
    return seen_s && now_s - *seen_s < kAlarm_s;
  };
  if (holds(displaced_s_)) alarms.push_back(alarm::ptu_moved_unconnected());
  if (holds(frozen_s_) || holds(contradicted_s_))
    alarms.push_back(alarm::ptu_positions_contradict_pictures());
  if (holds(unordered_s_)) {
    alarms.push_back(alarm::ptu_moves_unordered());
  } else if (holds(picture_moved_s_)) {
    alarms.push_back(alarm::ptu_picture_moves_unordered());
  }
  if (holds(unstopped_s_)) alarms.push_back(alarm::ptu_does_not_stop());
  if (distrusted_ || holds(ignored_s_)) alarms.push_back(alarm::ptu_ignores_orders());
  if (emergency_)
    alarms.push_back(stands() ? alarm::ptu_emergency_stop() : alarm::ptu_emergency_stop_moving());
  return alarms;
}

}  // namespace ols::mount
