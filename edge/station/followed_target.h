// The target that the station's tracker follows: either the operator designated it, or it was
// acquired along a slew. An acquired target is on trial until the tracker believes in it. During a
// trial the station's own target is set aside.
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
  // Starts a trial with the object in the box; the own target is set aside.
  bool try_found(const camera::Frame& frame, const cv::Rect2d& box);
  // Ends a trial with success: its target becomes the own target.
  void confirm();
  enum class Dropped { kNothing, kBackToOwn, kNothingLeft };
  // Ends a trial that takes too long. Returns what happened.
  Dropped drop_unproven(double time_s);

  // nullopt if the tracker refused the frame. The predicted motion is computed from the PTU's
  // angles.
  std::optional<tracker::TrackerOutput> track(const camera::Frame& frame,
                                              const PointingModel& pointing);
  void search_near(const Eigen::Vector2d& pixel, double sd_px) {
    tracker_->search_near(pixel, sd_px);
  }
  // Forgets the target if it has this id, also one that is set aside. False if it has another.
  bool let_go(std::int64_t track_id);
  // Call when PTU angles from now on are not comparable with earlier ones.
  void forget_angles();

  bool exists() const { return kind_ != Kind::kNone; }
  bool on_trial() const { return kind_ == Kind::kUnproven; }
  bool is_designated() const { return kind_ == Kind::kDesignated; }  // by an operator
  std::int64_t track_id() const { return track_id_; }
  // A new id for another object of this station; no two objects share an id.
  std::int64_t new_track_id() { return ++last_track_id_; }
  // 1-sigma of the box's centre on the target in the newest frame. The centre is a point fixed on
  // the target, so its distance from the target's middle grows in the image as the target does.
  double centring_sd_px() const;
  const std::optional<tracker::TrackerOutput>& last_output() const { return last_output_; }
  // Mid-exposure of the frame that the tracker processed last; nullopt if it is not comparable with
  // later ones.
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
  struct Own {  // the station's own target, while set aside
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
  double first_size_px_ = 0.0;       // of the box with which the target began
  double found_s_ = 0.0;             // mid-exposure of the frame in which the trial began
  std::optional<Own> own_;
  std::optional<tracker::TrackerOutput> last_output_;
  int disagreeing_in_a_row_ = 0;
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
