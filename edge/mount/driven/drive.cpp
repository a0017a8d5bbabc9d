#include "edge/mount/driven/drive.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "conditions/alarms.h"
#include "geometry/angles.h"

namespace ols::mount {
namespace {

using Kind = OrderedMotion::Kind;

constexpr double kStopAgain_s = 0.4;       // until a stop that changed nothing is repeated
constexpr double kBrakes_s = 0.2;          // after a stop: the mount may still be braking
constexpr double kOldPosition_s = 1.0;     // with an older position there is no motion
constexpr double kAhead_s = 0.5;           // longest extrapolation by the ordered rate
constexpr double kAfterUnordered_s = 2.0;  // without motion, after one that only pictures showed
constexpr double kRefused_s = 10.0;        // without motion, after ignored orders
constexpr double kRateStep_rad_s = radians(0.1);
constexpr double kRateShare = 0.05;   // a smaller change of rate waits for the renewal
constexpr double kRenew = 1.0 / 3.0;  // of the lease: a motion is then renewed
constexpr double kLastPiece_rad = radians(2.0);
constexpr double kAbsoluteAgain_s = 5.0;  // a place that was not reached is ordered again
constexpr double kSmallAgain_s = 1.0;     // between orders of places within a position's sigma
constexpr double kSamePlace_rad = radians(0.01);
constexpr double kUnlimited_rad = 1e9;

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
  want_stop();
  intake_.restart();
  positions_.clear();
  picture_watch_.connected();
}

void Drive::lost() {
  goal_.reset();
  const bool answered = !std::exchange(is_sent_, false);
  const double lasts_s = std::max(config_.lease_s, offered_.least_lease_s);
  position_watch_.lost(positions_, ordered_, answered, lasts_s);
  positions_.clear();
}

void Drive::set_goal(const std::optional<Goal>& goal) { goal_ = emergency_ ? std::nullopt : goal; }

void Drive::emergency_halt() {
  emergency_ = true;
  want_stop();
  goal_.reset();
  ++emergencies_;
}

std::optional<double> Drive::last_position_s() const {
  return positions_.empty() ? std::nullopt : std::optional(positions_.newest_s());
}

bool Drive::stop_is_due(double now_s) const {
  const bool again = now_s - ordered_.stop_s >= kStopAgain_s;
  if (stop_wanted_ && (stops_ == 0 || again)) return true;
  return ordered_.kind == Kind::kNone && again &&
         positions_.move_since(ordered_.stop_s + kBrakes_s);
}

void Drive::want_stop() {
  stop_wanted_ = true;
  stops_ = 0;
}

void Drive::obey(Demand demand, double now_s) {
  if (demand != Demand::kNothing) stop_wanted_ = true;
  if (demand != Demand::kGiveUp) return;
  stops_ = 0;
  refused_until_s_ = now_s + kRefused_s;
}

// Some cameras obey only one of the two.
Order Drive::stop_order() const {
  const bool by_velocity = stops_ % 2 == 1 && offered_.continuous;
  return {by_velocity ? Act::kVelocity : Act::kStop, {}};
}

Order Drive::next(double now_s) {
  if (stop_is_due(now_s)) return stop_order();
  const bool old = positions_.empty() || now_s - positions_.newest_s() > kOldPosition_s;
  if (ordered_.kind != Kind::kNone && old && now_s - ordered_.ordered_s > kOldPosition_s) {
    want_stop();
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
  const PanTilt& newest = positions_.newest();
  const double ahead_s = std::clamp(now_s - positions_.newest_s(), 0.0, kAhead_s);
  return {newest.pan_rad + ordered_.rate.pan_rad * ahead_s,
          newest.tilt_rad + ordered_.rate.tilt_rad * ahead_s};
}

// nullopt: no motion is wanted or permitted.
std::optional<PanTilt> Drive::wanted_rate(double now_s) const {
  if (!goal_ || now_s < refused_until_s_ || !offered_.continuous) return std::nullopt;
  Goal goal = *goal_;
  goal.rests = false;  // proportional: answers are too late for the shortest braking
  const PanTilt now = angles_now(now_s);
  const auto command = ptu::servo_step(config_.servo, limits_, goal, now, now_s, ordered_.rate);
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
  const PanTilt& at = positions_.newest();
  if (offered_.continuous && distance(to, at) > kLastPiece_rad) return std::nullopt;
  const AngleBox travel = mount::travel(limits_);
  if (to.pan_rad < travel.pan_min_rad || to.pan_rad > travel.pan_max_rad ||
      to.tilt_rad < travel.tilt_min_rad || to.tilt_rad > travel.tilt_max_rad ||
      blocked(limits_.keep_out, spanned(to, at)))
    return std::nullopt;
  const bool there = distance(to, at) < 2.0 * intake_.sd_rad();
  const double changed_rad =
      ordered_.kind == Kind::kAbsolute ? distance(ordered_.place, to) : kUnlimited_rad;
  const double since_s = now_s - ordered_.ordered_s;
  if (changed_rad < kSamePlace_rad && (there || since_s < kAbsoluteAgain_s)) return Order{};
  if (changed_rad < intake_.sd_rad() && since_s < kSmallAgain_s) return Order{};
  return Order{Act::kAbsolute,
               {position_of(config_.pan, to.pan_rad), position_of(config_.tilt, to.tilt_rad)}};
}

Order Drive::motion(double now_s) {
  if (const auto order = last_piece(now_s)) return *order;
  const auto rate = wanted_rate(now_s);
  if (!rate || fastest(*rate) == 0.0) {
    if (ordered_.kind == Kind::kNone) return {};
    want_stop();
    return stop_order();
  }
  const bool new_position = positions_.newest_s() > moved_for_s_;
  const bool expires = now_s - ordered_.ordered_s > kRenew * config_.lease_s;
  const bool other = ordered_.kind != Kind::kVelocity || differs(*rate, ordered_.rate);
  if (!expires && !(other && new_position)) return {};
  return {Act::kVelocity,
          {velocity_of(config_.pan, rate->pan_rad, offered_.continuous->x),
           velocity_of(config_.tilt, rate->tilt_rad, offered_.continuous->y)}};
}

void Drive::done(const Order& order, double now_s) {
  is_sent_ = false;
  const bool stands_for_stop =
      order.act == Act::kVelocity && order.vector.x == 0.0 && order.vector.y == 0.0;
  if (order.act == Act::kStop || stands_for_stop) return stop_accepted(now_s);
  if (order.act == Act::kVelocity || order.act == Act::kAbsolute) motion_accepted(order, now_s);
}

void Drive::stop_accepted(double now_s) {
  if (stops_++ > 0) ++stops_repeated_;
  stop_wanted_ = false;
  ordered_.kind = Kind::kNone;
  ordered_.rate = {};
  ordered_.stop_s = now_s;
  if (!ordered_.rests_since_s) ordered_.rests_since_s = now_s;
  intake_.ordered(ordered_.rate, now_s);
  position_watch_.stop_ordered();
}

void Drive::motion_accepted(const Order& order, double now_s) {
  stops_ = 0;
  moved_for_s_ = positions_.empty() ? 0.0 : positions_.newest_s();
  ordered_.ordered_s = now_s;
  ordered_.rests_since_s.reset();
  ordered_.arrived_s.reset();
  if (order.act == Act::kVelocity) {
    ordered_.kind = Kind::kVelocity;
    ordered_.rate = {order.vector.x * config_.pan.speed_per_unit_rad,
                     order.vector.y * config_.tilt.speed_per_unit_rad};
  } else {
    ordered_.kind = Kind::kAbsolute;
    ordered_.rate = {};
    ordered_.place = {angle_of(config_.pan, order.vector.x),
                      angle_of(config_.tilt, order.vector.y)};
  }
  const bool rate_known = ordered_.kind == Kind::kVelocity;
  intake_.ordered(rate_known ? std::optional(ordered_.rate) : std::nullopt, now_s);
  position_watch_.motion_ordered(positions_, ordered_);
  picture_watch_.motion_ordered();
}

// A refused motion may be under way all the same.
void Drive::failed(const Order& order, double now_s) {
  is_sent_ = false;
  if (order.act == Act::kStop) {
    ++stops_;
    ordered_.stop_s = now_s;
  }
  if (order.act != Act::kVelocity && order.act != Act::kAbsolute) return;
  want_stop();
  refused_until_s_ = now_s + kRefused_s;
}

void Drive::take(const Vector& position, double sent_s, double answered_s) {
  asked_s_ = sent_s;
  const PanTilt angles{angle_of(config_.pan, position.x), angle_of(config_.tilt, position.y)};
  const double now_s = 0.5 * (sent_s + answered_s) - config_.positions.delay_s;
  const bool goes = ordered_.kind == Kind::kAbsolute &&
                    distance(ordered_.place, angles) > positions_.least_motion_rad();
  const double rate_rad_s = goes ? config_.servo.max_speed_rad_s : fastest(ordered_.rate);
  intake_.add(angles, sent_s, answered_s, rate_rad_s);
  positions_.add(angles, now_s);
  if (ordered_.kind == Kind::kAbsolute && !goes && !ordered_.arrived_s) ordered_.arrived_s = now_s;
  obey(position_watch_.judge(positions_, ordered_, picture_watch_), now_s);
}

// After a motion without an order, no motion is ordered before the reported positions are judged by
// it, and before whoever ordered it may have ended.
void Drive::see(const SeenTurn& turn) {
  if (positions_.empty()) return;
  const Demand demand = picture_watch_.see(turn, positions_, ordered_);
  obey(demand, turn.to_s);
  if (demand == Demand::kStop)
    refused_until_s_ = std::max(refused_until_s_, turn.to_s + kAfterUnordered_s);
}

std::vector<AngleSample> Drive::take_samples() {
  auto samples = intake_.take();
  const bool frozen = !positions_.empty() && picture_watch_.frozen(positions_.newest_s());
  if (position_watch_.distrusted() || position_watch_.displaced() || frozen) samples.clear();
  return samples;
}

Drive::Counters Drive::counters() const {
  Counters counters{position_watch_.counters()};
  counters.stops_repeated = stops_repeated_;
  counters.emergencies = emergencies_;
  counters.unordered_in_picture = picture_watch_.unordered_motions();
  return counters;
}

std::vector<Alarm> Drive::alarms(double now_s) const {
  std::vector<Alarm> alarms;
  if (position_watch_.moved_unconnected(now_s)) alarms.push_back(alarm::ptu_moved_unconnected());
  if (picture_watch_.contradicted(now_s))
    alarms.push_back(alarm::ptu_positions_contradict_pictures());
  if (position_watch_.unordered(now_s)) {
    alarms.push_back(alarm::ptu_moves_unordered());
  } else if (picture_watch_.unordered(now_s)) {
    alarms.push_back(alarm::ptu_picture_moves_unordered());
  }
  if (position_watch_.unstopped(now_s) || picture_watch_.unstopped(now_s))
    alarms.push_back(alarm::ptu_does_not_stop());
  if (position_watch_.ignored(now_s)) alarms.push_back(alarm::ptu_ignores_orders());
  if (emergency_)
    alarms.push_back(stands() ? alarm::ptu_emergency_stop() : alarm::ptu_emergency_stop_moving());
  return alarms;
}

}  // namespace ols::mount
