// Chooses the next request to a mount that obeys velocities or positions: a question for its
// position, a motion, or a stop. Pure.
//
// Every velocity has a lease: it is ordered with the time-out `lease_s`, and renewed as long as it
// is wanted. When the orders cease, a mount that obeys the time-out stops. An absolute move has no
// time-out. It is ordered only for the last part of the way to a goal at rest, or if the mount
// obeys no velocities. After each connection, the first order is a stop. It is repeated until the
// reported positions no longer change.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "conditions/alarm.h"
#include "edge/mount/angle_history.h"
#include "edge/mount/driven/ordered_motion.h"
#include "edge/mount/driven/picture_watch.h"
#include "edge/mount/driven/position_intake.h"
#include "edge/mount/driven/position_watch.h"
#include "edge/mount/driven/recent_positions.h"
#include "edge/mount/goal.h"
#include "edge/mount/limits.h"
#include "edge/ptu/servo.h"

namespace ols::mount {

// A position or a velocity in the mount's own units.
struct Vector {
  double x = 0.0, y = 0.0;
};

struct Span {
  double min = 0.0, max = 0.0;
};

struct Space {
  Span x, y;
};

// The moves that a mount offers, each with the range of its numbers: to a position (absolute), at a
// velocity (continuous).
struct Moves {
  std::optional<Space> absolute, continuous;
  double least_lease_s = 0.0;  // a shorter lease of a velocity is not possible
};

// The linear relation between the angle of an axis and the mount's numbers. A negative factor means
// that the mount's number decreases while the angle increases.
struct AxisScale {
  double zero_rad = 0.0;            // the angle at position 0
  double per_unit_rad = 0.0;        // angle per unit of position
  double speed_per_unit_rad = 0.0;  // [rad/s] per unit of velocity
};

struct DriveConfig {
  AxisScale pan, tilt;
  Limits limits{radians(-180.0), radians(180.0), radians(-90.0), radians(90.0), {}, {}};
  ptu::ServoConfig servo{.gain_hz = 1.0, .max_speed_rad_s = radians(20.0)};
  PositionIntake::Config positions;
  double lease_s = 1.0;  // time-out of a velocity
  double poll_s = 0.1;   // interval between questions for the position
};

enum class Act { kWait, kStatus, kStop, kVelocity, kAbsolute };
struct Order {
  Act act = Act::kWait;
  Vector vector;  // position or velocity in the mount's units; a velocity of 0 is a stop
};

class Drive {
 public:
  explicit Drive(const DriveConfig& config) : config_(config), intake_(config.positions) {}

  // Call after each connection. The mount's position and motion then count as unknown.
  void connected(const Moves& moves);
  void lost();  // call when the connection is lost

  void set_goal(const std::optional<Goal>& goal);
  bool has_goal() const { return goal_.has_value(); }
  void emergency_halt();
  void clear_emergency() { emergency_ = false; }
  bool in_emergency() const { return emergency_; }

  Order next(double now_s);
  // Call done() when the mount has accepted the order. Call failed() when it has refused the order
  // or could not be reached.
  void done(const Order& order, double now_s);
  void failed(const Order& order, double now_s);
  void take(const Vector& position, double sent_s, double answered_s);
  // Takes a turn of the camera between two pictures. The pictures may show a motion that the
  // reported positions do not.
  void see(const SeenTurn& turn);

  // The samples since the last call. There are none while the reported positions do not follow the
  // orders, for half a minute after they stayed while the pictures moved, nor, after a motion
  // without a connection, before the mount has come to rest.
  std::vector<AngleSample> take_samples();
  const Limits& limits() const { return limits_; }
  bool has_position() const { return !positions_.empty(); }
  // Whether no motion is ordered and the reported positions do not change.
  bool stands() const { return ordered_.kind == OrderedMotion::Kind::kNone && !positions_.move(); }
  std::optional<double> last_position_s() const;
  const PositionIntake& intake() const { return intake_; }
  std::vector<Alarm> alarms(double now_s) const;

  struct Counters : PositionWatch::Counters {
    std::uint64_t stops_repeated = 0, emergencies = 0;
    std::uint64_t unordered_in_picture = 0;  // motions without an order that the pictures showed
  };
  Counters counters() const;

 private:
  bool stop_is_due(double now_s) const;
  Order stop_order() const;
  void want_stop();
  void obey(Demand demand, double now_s);
  std::optional<PanTilt> wanted_rate(double now_s) const;
  Order motion(double now_s);
  std::optional<Order> last_piece(double now_s) const;
  PanTilt angles_now(double now_s) const;
  void stop_accepted(double now_s);
  void motion_accepted(const Order& order, double now_s);

  DriveConfig config_;
  Limits limits_ = config_.limits;
  Moves offered_;
  PositionIntake intake_;
  std::optional<Goal> goal_;
  bool emergency_ = false;
  std::uint64_t emergencies_ = 0, stops_repeated_ = 0;

  OrderedMotion ordered_;
  double moved_for_s_ = 0.0;  // time of the newest position when the last motion was ordered
  double asked_s_ = -1e9;     // time of the last question for the position
  bool stop_wanted_ = true;
  int stops_ = 0;  // number of stops since the last motion
  // No motion is ordered before this time, because the mount has refused or ignored one.
  double refused_until_s_ = -1e9;
  bool is_sent_ = false;  // a motion, and neither done() nor failed() was called

  RecentPositions positions_{config_.positions.sd_rad};
  PositionWatch position_watch_;
  PictureWatch picture_watch_;
};

}  // namespace ols::mount
