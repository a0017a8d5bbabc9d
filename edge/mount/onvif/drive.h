// What to ask an ONVIF camera next: its position, a motion, or a stop. Pure.
//
// No motion outlives its lease. A velocity is ordered for `lease_s`, and again while it is still
// wanted; a camera that keeps its own time-out stands when orders cease. An absolute move, which
// has no time-out, is ordered only for the last piece of way to a goal at rest. A stop is ordered
// first after each connection, and is repeated until the reported positions stand still.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "conditions/alarm.h"
#include "edge/mount/angle_history.h"
#include "edge/mount/goal.h"
#include "edge/mount/limits.h"
#include "edge/mount/onvif/position_intake.h"
#include "edge/mount/onvif/soap_answer.h"
#include "edge/mount/onvif/soap_request.h"
#include "edge/ptu/servo.h"

namespace ols::onvif {

// Angles are linear in the numbers of the camera's spaces; a negative factor is another direction.
struct AxisScale {
  double zero_rad = 0.0;            // the angle at position 0
  double per_unit_rad = 0.0;        // of a position
  double speed_per_unit_rad = 0.0;  // [rad/s] of a velocity
};

struct DriveConfig {
  AxisScale pan, tilt;
  mount::Limits limits{radians(-180.0), radians(180.0), radians(-90.0), radians(90.0), {}, {}};
  ptu::ServoConfig servo{.gain_hz = 1.0, .max_speed_rad_s = radians(20.0)};
  PositionIntake::Config positions;
  double lease_s = 1.0;  // of a velocity
  double poll_s = 0.1;   // between two questions for the position
};

enum class Act { kWait, kStatus, kStop, kVelocity, kAbsolute };
struct Order {
  Act act = Act::kWait;
  Vector vector;  // of a motion, in the camera's numbers; a velocity of 0 stands for a stop
};

class Drive {
 public:
  explicit Drive(const DriveConfig& config) : config_(config), intake_(config.positions) {}

  // A connection: where it is and what it does is unknown.
  void connected(const PtzOptions& options);
  void lost();  // the connection

  void set_goal(const std::optional<mount::Goal>& goal);
  void emergency_halt();
  void clear_emergency() { emergency_ = false; }
  bool in_emergency() const { return emergency_; }

  Order next(double now_s);
  // The camera has accepted the order; or it, or the way to it, refused.
  void done(const Order& order, double now_s);
  void failed(const Order& order, double now_s);
  void take(const PtzStatus& status, double sent_s, double answered_s);

  // None while its positions do not follow the orders.
  std::vector<mount::AngleSample> take_samples() {
    auto samples = intake_.take();
    if (distrusted_) samples.clear();
    return samples;
  }
  const mount::Limits& limits() const { return limits_; }
  bool has_position() const { return !seen_.empty(); }
  // Positions are reported, and do not change.
  bool stands() const { return motion_ == Motion::kNone && !moves(); }
  std::optional<double> last_position_s() const;
  const PositionIntake& intake() const { return intake_; }
  std::vector<Alarm> alarms(double now_s) const;

  struct Counters {
    std::uint64_t stops_repeated = 0, unordered_motions = 0, orders_ignored = 0, emergencies = 0;
  };
  const Counters& counters() const { return counters_; }

 private:
  enum class Motion { kNone, kVelocity, kAbsolute };
  struct Seen {
    double time_s;
    PanTilt angles;
  };
  // One axis since it was ordered into this direction.
  struct Travel {
    double since_s = 0.0, ordered_rad = 0.0, from_rad = 0.0;
    int sign = 0;
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
  void add_travel(Travel& travel, double rate_rad_s, double angle_rad, double now_s);
  void judge_travel(const Travel& travel, double angle_rad, double now_s);
  void judge_rest(double now_s);

  DriveConfig config_;
  mount::Limits limits_ = config_.limits;
  PtzOptions options_;
  PositionIntake intake_;
  std::optional<mount::Goal> goal_;
  bool emergency_ = false;

  Motion motion_ = Motion::kNone;
  PanTilt rate_;              // [rad/s] ordered
  PanTilt absolute_;          // ordered
  double ordered_s_ = 0.0;    // the last motion
  double moved_for_s_ = 0.0;  // time of the position that the last motion was made for
  double asked_s_ = -1e9;     // the last question for the position
  bool stop_wanted_ = true;
  int stops_ = 0;                        // since the last motion
  double stop_s_ = -1e9;                 // the last stop
  std::optional<double> rests_since_s_;  // stop accepted, no motion ordered since
  std::optional<PanTilt> rest_;          // where it came to rest

  std::deque<Seen> seen_;  // positions of the last second
  Travel pan_travel_, tilt_travel_;
  bool distrusted_ = false;        // since then no position has followed an order
  double refused_until_s_ = -1e9;  // it did not do what it was ordered to
  std::optional<double> unordered_s_, unstopped_s_, ignored_s_;  // last seen
  Counters counters_;
};

}  // namespace ols::onvif
