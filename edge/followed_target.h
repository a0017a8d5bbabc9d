// What a station's tracker follows: the target that the operator designated, or one that was found
// along a slew and is dropped again when it is not believed in soon. While a found one is on trial,
// the station's own is put aside.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "edge/camera/frame.h"
#include "edge/pointing_model.h"
#include "edge/station_config.h"
#include "edge/tracker/target_tracker.h"

namespace ols::station {

class FollowedTarget {
 public:
  FollowedTarget(const StationConfig& config, std::unique_ptr<tracker::TargetTracker> tracker)
      : config_(config), tracker_(std::move(tracker)) {}

  // Begins with the box; an error: the tracker refuses it, and nothing has changed.
  std::optional<tracker::TrackerError> designate(const camera::Frame& frame, const cv::Rect2d& box);
  // The same on trial, the own target put aside.
  bool try_found(const camera::Frame& frame, const cv::Rect2d& box);
  // The one on trial was believed in: it is the own target from here on.
  void confirm();
  enum class Dropped { kNothing, kBackToOwn, kNothingLeft };
  // Ends a trial that takes too long.
  Dropped drop_unproven(double time_s);

  // Nothing: the tracker refuses the frame. Its predicted motion comes from the PTU's angles.
  std::optional<tracker::TrackerOutput> track(const camera::Frame& frame,
                                              const PointingModel& pointing);
  void search_near(const Eigen::Vector2d& pixel, double sd_px) {
    tracker_->search_near(pixel, sd_px);
  }
  // The angles of the frames tracked so far say nothing about those to come.
  void forget_angles();

  bool exists() const { return kind_ != Kind::kNone; }
  bool on_trial() const { return kind_ == Kind::kUnproven; }
  std::int64_t track_id() const { return track_id_; }
  double centring_sd_px() const;  // of its box on the target
  const std::optional<tracker::TrackerOutput>& last_output() const { return last_output_; }
  // Frame after frame the picture moves otherwise than the PTU's angles say.
  bool motion_disagrees() const { return disagreeing_in_a_row_ >= config_.disagreeing_frames; }
  const std::map<std::string, double>& counters() const { return counters_; }

 private:
  enum class Kind { kNone, kDesignated, kUnproven, kAcquired };
  struct Own {  // put aside
    Kind kind = Kind::kNone;
    std::int64_t track_id = 0;
    std::optional<double> tracked_s;
  };
  void begin(Kind kind, double time_s);
  void compare_motion(const tracker::TrackerOutput& output);

  const StationConfig config_;
  std::unique_ptr<tracker::TargetTracker> tracker_;
  Kind kind_ = Kind::kNone;
  std::int64_t track_id_ = 0, last_track_id_ = 0;
  std::optional<double> tracked_s_;  // mid-exposure of the last frame given to the tracker
  double found_s_ = 0.0;             // mid-exposure of the frame with the box on trial
  std::optional<Own> own_;
  std::optional<tracker::TrackerOutput> last_output_;
  int disagreeing_in_a_row_ = 0;
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
