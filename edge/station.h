// What a station does, decided without devices, clocks or messages: designate, track, coast, lose,
// be slewed, manual, stopped, emergency. Times are the station's monotonic clock [s]. One instance
// a station, called from one thread.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edge/angular_track.h"
#include "edge/ptu/angle_history.h"
#include "edge/ptu/driver.h"
#include "edge/ptu/servo.h"
#include "edge/slew_senders.h"
#include "edge/station_types.h"
#include "edge/tracker/acquisition.h"
#include "edge/tracker/target_tracker.h"

namespace ols {

struct StationConfig {
  StationGeometry geometry;
  AngleHistory::Config angles;
  PtuLimits limits;
  AngularTrack::Config motion;
  double designation_sd_px = 1.0;    // how well a designated box is centred on the target
  double tracking_belief = 0.5;      // at least this to be tracking
  double coast_s = 0.7;              // on the motion model after the last believed frame
  int reacquire_frames = 3;          // believed frames in a row that end a search
  double angle_wait_s = 0.03;        // how long a frame may wait for the PTU sample after it
  double frame_memory_s = 1.0;       // frames kept for a designation in the past
  double search_interval_s = 0.5;    // while searching, the tracker is sent to the slew's pixel
  double search_sd_px = 25.0;        // at least, around that pixel; not above search_sd_most_px()
  bool acquire_by_slew = true;       // a slewed station without a target looks for one itself,
  double own_target_s = 5.0;         // one with a target after it has looked for that for so long
  double unacquired_alarm_s = 10.0;  // slewed for so long without a target: an alarm
  double acquisition_sd_px = 3.0;    // how well the box found is centred on the target
  // The picture's own motion between two frames may differ so far from that of the PTU's angles.
  double prediction_error_px = 20.0;
  int disagreeing_frames = 5;  // in a row that raise the alarm
  AcquisitionConfig acquisition;
  bool homing_allowed = true;     // on command
  bool rearm_over_bus = false;    // by whoever sends it; else by a hand at the station only
  double slew_lease_max_s = 2.0;  // a longer lease is refused
  double point_time_s = 15.0;     // an operator's move may take this long
  double max_age_s = 1.0;         // older frames are not tracked, older bearings not sent

  double search_sd_most_px() const { return geometry.camera.width_px / 4.0; }
};

class Station {
 public:
  Station(const StationConfig& config, std::unique_ptr<TargetTracker> tracker);

  // What happens to the station. Samples and frames come in time order, each kind for itself.
  void on_angles(const AngleSample& sample);
  void on_frame(const Frame& frame) { on_frame(frame, now_s_); }
  // A frame that is older than max_age_s at now_s is dropped: the tracker gets no backlog.
  void on_frame(const Frame& frame, double now_s);
  void set_limits(const PtuLimits& limits) { config_.limits = limits; }
  // What the PTU's angles are worth. In doubt nothing is pointed or slewed, and what is known of
  // angles is forgotten; a target is kept, and slews lead back to it later.
  void set_reference(PtuReference reference);
  // Before the first call the pose is that of the configured geometry. Without a position there
  // are no bearings.
  void set_pose(const StationPose& pose);
  // The emergency stop's level, also when it has not changed. Pressed once, nothing moves until it
  // is released, rearm() was accepted, and a command came after that.
  void emergency_stop(bool pressed, double now_s);

  // Commands; what is refused changes nothing but its counter.
  Refusal designate(const DesignateCommand& command, double now_s);
  Refusal slew(const SlewCommand& command, double now_s);
  Refusal point(const PointCommand& command, double now_s);
  // take_stop() says so once: what the unit does by itself ends too. For kStopHold_s nothing but an
  // emergency's rearming is obeyed: what was sent before a stop, or crosses it, must not undo it.
  void stop(double now_s);
  // As a station that was stopped begins again: like stop(), but an operator may go on at once.
  void begin_stopped();
  static constexpr double kStopHold_s = 1.0;
  Refusal release(double now_s);
  // After an emergency stop, by a hand at the station: leads to kStopped, from where the operator
  // goes on.
  Refusal rearm(double now_s);
  // The same from afar, where anybody may send it: refused unless the site lets it.
  Refusal rearm_over_bus(double now_s);
  // The unit shall home; take_home() says so once.
  Refusal home(double now_s);
  // A person vouches for the unit's reference; take_reference_ok() says so once.
  Refusal reference_ok(double now_s);
  bool take_stop() { return std::exchange(stop_, false); }
  bool take_home() { return std::exchange(home_, false); }
  bool take_reference_ok() { return std::exchange(reference_ok_, false); }

  // Lets time pass: leases and coasting end, state times grow. Returns the bearings whose PTU
  // angles are known by now.
  std::vector<Bearing> step(double now_s);

  // Where the PTU shall be; nothing: halt.
  std::optional<ServoGoal> goal(double now_s) const;

  StationState state() const { return state_; }
  std::optional<cv::Rect2d> target_box() const;  // in the newest frame
  StationSnapshot snapshot() const;

 private:
  struct Measured {  // a frame's pixel that waits for the PTU angles of its exposure
    double arrived_s = 0.0;
    double mid_exposure_s = 0.0;
    double stamp_sd_s = 0.0;
    StampSource stamp_source = StampSource::kCamera;
    TrackerOutput output;
    std::int64_t track_id = 0;
    double designation_sd_px = 0.0;
  };

  // What the tracker looks for: nothing, what the operator marked, or what was found along a slew,
  // which is dropped again when it is not believed in soon.
  enum class Template { kNone, kDesignated, kUnproven, kAcquired };

  // What the station looked for before it tries what it has found along a slew.
  struct OwnTarget {
    Template kind = Template::kNone;
    std::int64_t track_id = 0;
    std::optional<double> tracked_s;
  };
  // The time in which a slew has led to a place that is in the picture, by frames.
  struct InView {
    static constexpr double kNever = -std::numeric_limits<double>::infinity();
    double from_s = 0.0, to_s = kNever;
    double own_from_s = kNever;  // since when it has been the own target that is looked for
  };

  Refusal count(Refusal refusal, const char* command);
  Refusal judge(const SlewCommand& command, double now_s) const;
  void enter(StationState state);
  bool follows_target() const;
  const Frame* remembered(const std::optional<double>& time_s) const;
  TrackerInput tracker_input(const Frame& frame) const;
  void track(const Frame& frame);
  void judge(bool believed, double time_s);
  std::optional<Bearing> bearing(const Measured& measured);
  bool worth_sending(const Bearing& bearing);
  void follow(const Bearing& bearing, const PixelSight& pixel);
  void search_along_slew();
  struct Expected {  // of the slew's target in a frame
    Eigen::Vector2d pixel;
    PanTilt angles;
  };
  std::optional<Expected> expected(const Frame& frame) const;
  bool is_where_slewed(const Frame& frame, const TrackerOutput& output) const;
  double search_sd_px() const;
  void note_in_view(const Frame& frame);
  bool looks_for_anything() const;
  std::string slewed_in_vain() const;
  void acquire(const Frame& frame);
  void take(const Frame& frame, const cv::Rect2d& box);
  void drop_unproven(double time_s);
  void take_back_own(double time_s);
  void compare_motion(const TrackerOutput& output);
  // The PTU angles for a direction, or nothing when the unit cannot point there.
  std::optional<PanTilt> reachable(const AzimuthElevation& direction) const;
  void expire(double now_s);
  void forget_angles();
  bool without_reference() const;
  bool stop_holds(double now_s) const;
  std::optional<ServoGoal> slew_goal() const;

  StationConfig config_;
  std::unique_ptr<TargetTracker> tracker_;
  AngleHistory history_;
  AngularTrack motion_;
  StationState state_ = StationState::kIdle;
  int disagreeing_in_a_row_ = 0;
  bool stop_pressed_ = false;
  PtuReference reference_ = PtuReference::kUnknown;
  bool home_ = false, reference_ok_ = false, stop_ = false;  // wanted
  std::optional<double> stopped_s_;                          // by the last stop
  StationPose pose_;
  StationPose revision_pose_;  // of which the bearings' pose_revision speaks
  std::int64_t pose_revision_ = 0;

  std::deque<Frame> frames_;  // the last frame_memory_s
  std::deque<Measured> waiting_;
  std::optional<double> tracked_s_;  // mid-exposure of the last frame given to the tracker
  std::optional<TrackerOutput> last_output_;
  double believed_s_ = 0.0;  // mid-exposure of the last believed frame
  int believed_in_a_row_ = 0;
  double searched_s_ = 0.0;  // when the tracker was last told where to search
  std::int64_t track_id_ = 0, last_track_id_ = 0;
  Template template_ = Template::kNone;
  std::optional<OwnTarget> own_;  // while another one is unproven
  InView in_view_;
  Acquisition acquisition_;
  double acquired_s_ = 0.0;  // mid-exposure of the frame with the box found
  std::optional<SlewCommand> slew_;
  SlewSenders slew_senders_;
  std::optional<ServoGoal> point_;
  double now_s_ = 0.0;  // of the last step
  double frame_latency_s_ = 0.0;
  std::map<std::string, double> counters_;
};

}  // namespace ols
