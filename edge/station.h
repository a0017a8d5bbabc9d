// What a station does, decided without devices, clocks or messages: designate, track, coast, lose,
// be slewed, manual, stopped, emergency. Times are the station's monotonic clock [s]. One instance
// a station, called from one thread.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edge/active_slew.h"
#include "edge/angular_track.h"
#include "edge/bearing_queue.h"
#include "edge/command_judgement.h"
#include "edge/followed_target.h"
#include "edge/frame_history.h"
#include "edge/pointing_model.h"
#include "edge/slew_search.h"
#include "edge/station_config.h"
#include "edge/station_mode.h"
#include "edge/station_types.h"
#include "edge/tracker/acquisition.h"
#include "edge/tracker/target_tracker.h"

namespace ols::station {

// What the unit is told beside its goal.
struct UnitActions {
  bool stop = false;  // whatever it does by itself: homing
  bool home = false;
  bool reference_ok = false;  // a person vouches for it
};

struct StationOutput {
  std::vector<Bearing> bearings;       // those whose PTU angles are known by now
  std::optional<ptu::ServoGoal> goal;  // of the PTU; nothing: halt
};

class Station {
 public:
  Station(const StationConfig& config, std::unique_ptr<tracker::TargetTracker> tracker);

  // What happens to the station. Samples and frames come in time order, each kind for itself.
  void on_angles(const ptu::AngleSample& sample);
  void on_frame(const camera::Frame& frame) { on_frame(frame, now_s_); }
  // A frame that is older than max_age_s at now_s is dropped: the tracker gets no backlog.
  void on_frame(const camera::Frame& frame, double now_s);
  // How far the unit can turn, once it is known.
  void set_limits(const ptu::PtuLimits& limits) { pointing_.set_limits(limits); }
  // What the PTU's angles are worth. In doubt nothing is pointed or slewed, and what is known of
  // angles is forgotten; a target is kept, and slews lead back to it later.
  void set_reference(ptu::PtuReference reference);
  // Before the first call the pose is that of the configured geometry. Without a position there
  // are no bearings.
  void set_pose(const sensors::StationPose& pose) { pointing_.set_pose(pose); }
  // The emergency stop's level, also when it has not changed. Pressed once, nothing moves until it
  // is released, rearm() was accepted, and a command came after that.
  void emergency_stop(bool pressed, double now_s);

  // Commands; what is refused changes nothing but its counter.
  Refusal designate(const DesignateCommand& command, double now_s);
  Refusal slew(const SlewCommand& command, double now_s);
  Refusal point(const PointCommand& command, double now_s);
  // What the unit does by itself ends too, as UnitActions says. For kStopHold_s nothing but an
  // emergency's rearming is obeyed: what was sent before a stop, or crosses it, must not undo it.
  void stop(double now_s);
  // As a station that was stopped begins again: like stop(), but an operator may go on at once.
  void begin_stopped();
  static constexpr double kStopHold_s = StationMode::kStopHold_s;
  Refusal release(double now_s);
  // After an emergency stop, by a hand at the station: leads to kStopped, from where the operator
  // goes on.
  Refusal rearm(double now_s);
  // The same from afar, where anybody may send it: refused unless the site lets it.
  Refusal rearm_over_bus(double now_s);
  // The unit shall home.
  Refusal home(double now_s);
  // A person vouches for the unit's reference.
  Refusal reference_ok(double now_s);
  // What the unit must do by now; each time once. Taken right after the commands, apart from
  // step(): a stop does not wait for the tracker.
  UnitActions take_actions() { return std::exchange(actions_, {}); }

  // Lets time pass: leases and coasting end, state times grow.
  StationOutput step(double now_s);

  // Where the PTU shall be; nothing: halt.
  std::optional<ptu::ServoGoal> goal(double now_s) const;

  StationState state() const { return mode_.state(); }
  std::optional<cv::Rect2d> target_box() const;  // in the newest frame
  StationSnapshot snapshot() const;

 private:
  Situation situation(double now_s) const { return {config_, mode_, pointing_, now_s}; }
  // A command was judged: the result is counted.
  Refusal count(Refusal refusal, const char* command);
  void pass_time(double now_s);
  void expire(double now_s);
  void enter(StationState state);
  void give_up_unit();
  void forget_angles();
  bool follows_target() const { return target_.exists() && mode_.may_track(); }
  void track(const camera::Frame& frame);
  void judge_belief(bool believed, double time_s);
  void drop_unproven(double time_s);
  void look_along_slew(const camera::Frame& frame);
  void follow(const MadeBearing& made);
  std::vector<std::string> alarms() const;
  std::map<std::string, double> counters() const;

  const StationConfig config_;
  StationMode mode_;
  PointingModel pointing_;
  FrameHistory frames_;
  FollowedTarget target_;
  SlewSearch search_;
  ActiveSlew slew_;
  BearingQueue bearings_;
  AngularTrack motion_;
  std::optional<ptu::ServoGoal> point_;
  UnitActions actions_;
  double believed_s_ = 0.0;  // mid-exposure of the last believed frame
  int believed_in_a_row_ = 0;
  double now_s_ = 0.0;
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
