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
#include <deque>
#include <optional>
#include <vector>

#include "conditions/alarm.h"
#include "edge/mount/angle_history.h"
#include "edge/mount/driven/picture_motion.h"
#include "edge/mount/driven/position_intake.h"
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
  bool has_position() const { return !seen_.empty(); }
  // Whether no motion is ordered and the reported positions do not change.
  bool stands() const { return motion_ == Motion::kNone && !moves(); }
  std::optional<double> last_position_s() const;
  const PositionIntake& intake() const { return intake_; }
  std::vector<Alarm> alarms(double now_s) const;

  struct Counters {
    std::uint64_t stops_repeated = 0, unordered_motions = 0, orders_ignored = 0, emergencies = 0;
    std::uint64_t moved_unconnected = 0;     // motions while there was no connection
    std::uint64_t unordered_in_picture = 0;  // motions without an order that the pictures showed
  };
  const Counters& counters() const { return counters_; }

 private:
  enum class Motion { kNone, kVelocity, kAbsolute };
  struct Seen {
    double time_s;
    PanTilt angles;
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

  bool moves_since(double time_s) const;
  bool moves() const { return moves_since(-1e9); }
  double seen_motion_rad() const;
  bool stop_is_due(double now_s) const;
  Order stop_order() const;
  std::optional<PanTilt> wanted_rate(double now_s) const;
  Order motion(double now_s);
  std::optional<Order> last_piece(double now_s) const;
  PanTilt angles_now(double now_s) const;
  PanTilt end_of_motion() const;
  void add_travel(Travel& travel, double rate_rad_s, double angle_rad, double now_s);
  void judge_travel(const Travel& travel, double angle_rad, double now_s);
  void begin_way(double now_s);
  void judge_way(const PanTilt& angles, double now_s);
  void judge_pictures_of_motion(double since_s, double way_rad, double now_s);
  void give_up_motion(double now_s);
  void judge_place_after_loss(const PanTilt& angles, double now_s);
  void judge_rest(double now_s);
  void move_in_picture(double time_s, bool moved_before);
  void judge_positions(double time_s);

  DriveConfig config_;
  Limits limits_ = config_.limits;
  Moves offered_;
  PositionIntake intake_;
  std::optional<Goal> goal_;
  bool emergency_ = false;

  Motion motion_ = Motion::kNone;
  PanTilt rate_;              // [rad/s] the ordered rate
  PanTilt absolute_;          // the ordered position
  double ordered_s_ = 0.0;    // time of the last order of a motion
  double moved_for_s_ = 0.0;  // time of the newest position when that order was given
  double asked_s_ = -1e9;     // time of the last question for the position
  bool stop_wanted_ = true;
  int stops_ = 0;                        // number of stops since the last motion
  double stop_s_ = -1e9;                 // time of the last stop
  std::optional<double> rests_since_s_;  // time of the first accepted stop since the last motion
  std::optional<PanTilt> rest_;          // position at which the mount came to rest
  std::optional<double> arrived_s_;      // when it was first reported at the ordered position

  std::deque<Seen> seen_;  // positions of the last 0.6 s
  Travel pan_travel_, tilt_travel_;
  std::optional<Way> way_;
  // true: the reported positions have not followed an order, nor any since then
  bool distrusted_ = false;
  // Where the mount can be by its last order; set when the connection is lost in motion.
  std::optional<AngleBox> may_be_in_;
  double displaced_since_s_ = -1e9;  // or since when it last moved
  bool displaced_ = false;  // it has moved without a connection, and has not come to rest since
  bool was_lost_ = false;   // and no position was reported since
  // No motion is ordered before this time, because the mount has refused or ignored one.
  double refused_until_s_ = -1e9;
  bool is_sent_ = false;  // a motion, and neither done() nor failed() was called
  // Times at which it was last observed that the mount moved without an order, did not stop,
  // ignored an order, or had moved without a connection.
  std::optional<double> unordered_s_, unstopped_s_, ignored_s_, displaced_s_;
  // The same: the reported positions stayed while the pictures moved, and the reverse.
  std::optional<double> frozen_s_, contradicted_s_;

  PictureMotion picture_;
  bool picture_moves_ = false;
  bool picture_rested_ = false;  // the picture was at rest since the last order of a motion
  PanTilt picture_rest_;         // the reported position at that time
  // When the pictures showed a motion without an order: the last time, and the first time of a
  // motion for which the positions are not judged yet.
  std::optional<double> picture_moved_s_, picture_moved_since_s_;
  Counters counters_;
};

}  // namespace ols::mount
