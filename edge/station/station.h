// Makes the decisions of a station about designation, tracking, coasting, loss, slews, manual
// control, stops and emergencies. It uses no devices, clocks or messages. Times are on the
// station's monotonic clock [s]. There is one instance for each station, called from one thread.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "conditions/alarm.h"
#include "edge/command/active_occlusion.h"
#include "edge/command/active_slew.h"
#include "edge/command/command_judgement.h"
#include "edge/command/manual_motion.h"
#include "edge/command/slew_search.h"
#include "edge/command/watch.h"
#include "edge/frames/frame_history.h"
#include "edge/frames/pointing_model.h"
#include "edge/frames/skyline_picture.h"
#include "edge/mount/goal.h"
#include "edge/station/angular_track.h"
#include "edge/station/bearing_queue.h"
#include "edge/station/detected_objects.h"
#include "edge/station/followed_target.h"
#include "edge/station/station_config.h"
#include "edge/station/station_mode.h"
#include "edge/station/station_snapshot.h"
#include "edge/station/station_types.h"
#include "edge/tracker/acquisition.h"
#include "edge/tracker/target_tracker.h"
#include "edge/video/video_frame.h"

namespace ols::station {

// Commands to the PTU, in addition to its goal, and to the lens.
struct UnitActions {
  bool stop = false;  // stop homing, the only motion that the PTU makes without a goal
  bool home = false;
  bool reference_ok = false;  // a person confirms the reference
  lens::LensOrder lens;       // commands to the motors of the lens
};

struct StationOutput {
  std::vector<Bearing> bearings;     // bearings whose PTU angles have become known
  std::optional<mount::Goal> goal;   // the PTU's goal; nullopt means halt
  std::optional<mount::Goal> watch;  // goal for the PTU if nothing else uses it
};

class Station {
 public:
  Station(const StationConfig& config, std::unique_ptr<tracker::TargetTracker> tracker);

  // Inputs. Angle samples must be in the order of their times; so must frames.
  void on_angles(const mount::AngleSample& sample);
  void on_frame(const camera::Frame& frame) {
    on_frame(frame, std::max(now_s_, frame.mid_exposure_s));
  }
  // For a motorised lens. on_zoom() takes each zoom position that the lens reports; set_lens()
  // takes the present positions of all its axes.
  void on_zoom(const lens::ZoomSample& sample) { pointing_.add(sample); }
  void set_lens(const lens::ByAxis<std::optional<double>>& positions) {
    pointing_.set_lens(positions);
  }
  // A frame that is older than `max_age_s` (StationConfig) at now_s is dropped, so that no backlog
  // arises.
  void on_frame(const camera::Frame& frame, double now_s);
  // For the detector, if there is one. picture_to_search() returns the next picture for the
  // detector, one at a time; on_found() then takes the detector's result. Pictures are provided in
  // every state of the station, as long as the mount's angles are trusted. `stars_show`: it is
  // night.
  std::optional<detector::Picture> picture_to_search(double now_s, bool stars_show = false) {
    return detected_.take(pointing_, now_s, stars_show);
  }
  void on_found(detector::Found found);
  // Sets the PTU's travel limits, once they are known.
  void set_limits(const mount::Limits& limits) { pointing_.set_limits(limits); }
  // Changes the geometry while the station runs. Everything that was measured with the previous
  // geometry is forgotten. `calibration`: the calibration from which the geometry comes, if any.
  void use(const StationGeometry& geometry, const std::optional<StationCalibration>& calibration);
  // Call if the reference views show that the station may have turned by these angles. From then
  // on, the covariance of bearings includes these errors.
  void doubt_setup(double heading_sd_rad, double tilt_sd_rad) {
    pointing_.doubt_setup(heading_sd_rad, tilt_sd_rad);
    ++setup_revision_;
  }
  // Sets whether the PTU's reference is valid. While the reference is missing or in doubt, the
  // station neither points nor follows slews, and discards the angles that it had. It keeps its
  // target; later, slews can lead the station back to the target.
  void set_reference(mount::Reference reference);
  // Until the first call, the pose is that of the configured geometry. Without a position, the
  // station sends no bearings.
  void set_pose(const sensors::StationPose& pose) { pointing_.set_pose(pose); }
  // Takes the state of the emergency stop. Call it even if this state has not changed. After a
  // press, nothing moves until three things have happened: the stop has been released, rearm() has
  // been accepted, and a new command has arrived.
  void emergency_stop(bool pressed, double now_s);

  // Commands. A refused command changes nothing but counters. There is one exception: a slew to an
  // unreachable direction is refused, but the station still lets go of its object
  // (let_go_track_id).
  Refusal designate(const DesignateCommand& command, double now_s);
  Refusal slew(const SlewCommand& command, double now_s);
  // Takes a prediction that the land hides the target, or that the land no longer hides it. While
  // the prediction is valid, a target that is not seen counts as hidden. The mount then waits where
  // the target will reappear.
  Refusal occlude(const OcclusionCommand& command, double now_s);
  Refusal point(const PointCommand& command, double now_s);
  // Like point(), but the goal is the direction of a pixel.
  Refusal centre(const CentreCommand& command, double now_s);
  // Moves the lens. This is permitted at any time, even during a stop.
  Refusal lens(const LensCommand& command, double now_s);
  // Turns the unit for the command's lease; rates of zero halt it.
  Refusal rate(const RateCommand& command, double now_s);
  // Stops the unit, and ends homing (see UnitActions). During the next kStopHold_s, only re-arming
  // is accepted: a command that was sent before the stop, or at the same time, must not undo the
  // stop.
  void stop(double now_s);
  // For a station that was stopped when its previous process ended. It differs from stop() in that
  // commands are accepted at once.
  void begin_stopped();
  static constexpr double kStopHold_s = StationMode::kStopHold_s;
  Refusal release(double now_s);
  // Re-arms after an emergency stop; call it when a person at the station has asked for it. The
  // state becomes kStopped, from which the operator can continue.
  Refusal rearm(double now_s);
  // Re-arms on a command from the bus. It is refused unless the configuration permits it, because
  // any program can send such a command.
  Refusal rearm_over_bus(double now_s);
  // Homes the unit.
  Refusal home(double now_s);
  // A person confirms the unit's reference.
  Refusal reference_ok(double now_s);
  // Returns the pending commands to the PTU and the lens, each once. Call it after the commands
  // above and before step(), so that a stop does not wait for the tracker.
  UnitActions take_actions() { return std::exchange(actions_, {}); }

  // The mount's turns between pictures since the last call, by the pictures alone, for the mount.
  std::vector<mount::SeenTurn> take_seen_turns() { return std::exchange(seen_turns_, {}); }

  // Advances time: ends leases and coasting that have expired, and counts the time in each state.
  StationOutput step(double now_s);

  // The PTU's goal; nullopt means halt.
  std::optional<mount::Goal> goal(double now_s) const;

  StationState state() const { return mode_.state(); }
  // The angles that the unit reported last.
  std::optional<PanTilt> reported_angles() const { return pointing_.reported_angles(); }
  const PointingModel& pointing() const { return pointing_; }
  std::optional<cv::Rect2d> target_box() const;  // in the newest frame
  StationSnapshot snapshot() const;
  // The newest frame for a viewer, without its utime. nullopt if the newest frame has another
  // mid-exposure; the station has then refused the expected frame.
  std::optional<video::VideoFrame> video_frame(double mid_exposure_s) const;
  // A recent picture that may show the skyline of the land (skyline_picture.h). nullopt if there is
  // none, or while the mount's angles are not trusted.
  std::optional<skyline::StatedPicture> skyline_picture() const;
  // Is incremented when later directions cannot be compared with earlier ones, or when the setup
  // comes into doubt. Causes are another geometry, moved reference views, and a missing or doubted
  // reference of the mount.
  int setup_revision() const { return setup_revision_; }

 private:
  StationParts parts() const {
    return {config_, mode_, pointing_, target_, follows_target(), now_s_};
  }
  Situation situation(double now_s) const { return {config_, mode_, pointing_, now_s}; }
  // Counts a command's result, and returns it.
  Refusal count(Refusal refusal, const char* command);
  void pass_time(double now_s);
  void expire(double now_s);
  void enter(StationState state);
  void give_up_unit();
  std::optional<mount::Goal> watch(double now_s);
  void forget_angles();
  Refusal stand_at(const PanTilt& angles, const char* command, double now_s);
  bool follows_target() const { return target_.exists() && mode_.may_track(); }
  bool follows_now() const {
    return mode_.is(StationState::kTracking) || mode_.is(StationState::kCoasting);
  }
  // The state of a station that does not see its target.
  StationState without_target() const;
  // The slew that the station follows without seeing its target. For a hidden target, this is the
  // predicted exit, if known.
  std::optional<SlewCommand> led_to() const;
  bool is_led() const { return mode_.is(StationState::kSlewed) || mode_.is(StationState::kHidden); }
  void track(const camera::Frame& frame);
  void see(const tracker::ImageMotion& motion, double from_s, const camera::Frame& frame);
  void follow_since(double mid_exposure_s);
  void judge_belief(bool believed, double time_s);
  void drop_unproven(double time_s);
  void look_along_slew(const camera::Frame& frame);
  void follow(const MadeBearing& made);
  std::vector<Alarm> alarms() const;
  std::map<std::string, double> counters() const;

  const StationConfig config_;
  StationMode mode_;
  PointingModel pointing_;
  FrameHistory frames_;
  FollowedTarget target_;
  SlewSearch search_;
  ActiveSlew slew_;
  ActiveOcclusion occlusion_;
  BearingQueue bearings_;
  DetectedObjects detected_;
  AngularTrack motion_;
  ManualMotion manual_;
  Watch watch_;
  UnitActions actions_;
  std::vector<mount::SeenTurn> seen_turns_;
  double believed_s_ = 0.0;      // mid-exposure of the last believed frame
  double last_belief_ = 0.0;     // its belief
  double hidden_since_s_ = 0.0;  // start of the present state kHidden
  int believed_in_a_row_ = 0;
  double now_s_ = 0.0;
  int setup_revision_ = 0;
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
