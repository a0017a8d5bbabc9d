// The target that the station's tracker follows: either the operator designated it, or the station
// acquired it along a slew. An acquired target is on trial until the tracker believes in it. During
// a trial, the station's previous target (its own target) is set aside.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "edge/camera/frame.h"
#include "edge/frames/pointing_model.h"
#include "edge/station/station_config.h"
#include "edge/tracker/target_tracker.h"

namespace ols::station {

class FollowedTarget {
 public:
  FollowedTarget(const StationConfig& config, std::unique_ptr<tracker::TargetTracker> tracker)
      : config_(config), tracker_(std::move(tracker)) {}

  // Starts to follow the object in the box. If the tracker refuses it, nothing changes.
  std::optional<tracker::TrackerError> designate(const camera::Frame& frame, const cv::Rect2d& box);
  // Starts a trial with the object in the box, and sets the own target aside. False if the tracker
  // refuses the object; nothing changes then.
  bool try_found(const camera::Frame& frame, const cv::Rect2d& box);
  // Ends a trial successfully: the target on trial becomes the own target.
  void confirm();
  enum class Dropped { kNothing, kBackToOwn, kNothingLeft };
  // Ends a trial after one second without confirm(). Returns what happened.
  Dropped drop_unproven(double time_s);

  // Passes the frame to the tracker, with the motion predicted from the PTU's angles. nullopt if
  // the tracker refuses the frame.
  std::optional<tracker::TrackerOutput> track(const camera::Frame& frame,
                                              const PointingModel& pointing);
  void search_near(const Eigen::Vector2d& pixel, double sd_px) {
    tracker_->search_near(pixel, sd_px);
  }
  // Forgets the target with this id, even if it is set aside. False if the target that is tracked
  // has another id.
  bool let_go(std::int64_t track_id);
  // Call when future PTU angles cannot be compared with earlier ones.
  void forget_angles();

  bool exists() const { return kind_ != Kind::kNone; }
  bool on_trial() const { return kind_ == Kind::kUnproven; }
  bool is_designated() const { return kind_ == Kind::kDesignated; }  // by an operator
  std::int64_t track_id() const { return track_id_; }
  // A new id for another object of this station; no two objects share an id.
  std::int64_t new_track_id() { return ++last_track_id_; }
  // 1-sigma [px] of the offset between the box's centre and the target's middle in the newest
  // frame. The centre is a fixed point of the target. Therefore, the offset grows in the image in
  // proportion to the target.
  double centring_sd_px() const;
  const std::optional<tracker::TrackerOutput>& last_output() const { return last_output_; }
  // Mid-exposure of the frame that the tracker processed last; nullopt if the PTU's angles at that
  // time cannot be compared with later ones.
  const std::optional<double>& tracked_s() const { return tracked_s_; }
  // The tracker's result for exactly this frame; null if it has not processed this frame.
  const tracker::TrackerOutput* output_of(double mid_exposure_s) const {
    return last_output_ && tracked_s_ == mid_exposure_s ? &*last_output_ : nullptr;
  }
  // Whether the image's motion has contradicted the PTU's angles in several consecutive frames.
  bool motion_disagrees() const { return disagreeing_in_a_row_ >= config_.disagreeing_frames; }
  const std::map<std::string, double>& counters() const { return counters_; }

 private:
  enum class Kind { kNone, kDesignated, kUnproven, kAcquired };
  struct Own {  // the station's own target while it is set aside
    Kind kind = Kind::kNone;
    std::int64_t track_id = 0;
    std::optional<double> tracked_s;
    double first_size_px = 0.0;
  };
  void begin(Kind kind, double time_s, const cv::Rect2d& box);
  void compare_motion(const tracker::TrackerOutput& output);

  const StationConfig config_;
  std::unique_ptr<tracker::TargetTracker> tracker_;
  Kind kind_ = Kind::kNone;
  std::int64_t track_id_ = 0, last_track_id_ = 0;
  std::optional<double> tracked_s_;  // mid-exposure of the last tracked frame
  double first_size_px_ = 0.0;  // size of the box in which the target was designated or acquired
  double found_s_ = 0.0;        // mid-exposure of the frame in which the trial began
  std::optional<Own> own_;
  std::optional<tracker::TrackerOutput> last_output_;
  int disagreeing_in_a_row_ = 0;
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
