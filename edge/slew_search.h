// Where and how a slewed station looks for its target: with the template of an earlier track, or
// for any object that behaves as the slew predicts. Pure.
#pragma once

#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "edge/camera/frame.h"
#include "edge/followed_target.h"
#include "edge/pointing_model.h"
#include "edge/station_config.h"
#include "edge/station_types.h"
#include "edge/tracker/acquisition.h"

namespace ols::station {

class SlewSearch {
 public:
  using Slew = std::optional<SlewCommand>;

  explicit SlewSearch(const StationConfig& config)
      : config_(config), acquisition_(config.acquisition) {}

  // The station enters another state; `found`: it tracks.
  void restart(bool found);
  // Each frame in which the station is slewed.
  void note_in_view(const camera::Frame& frame, const PointingModel& pointing, const Slew& slew);

  struct Place {
    Eigen::Vector2d pixel;
    double sd_px = 0.0;
  };
  // Where to send the tracker to look for its target. Empty: it was sent a moment ago, or the PTU
  // has not arrived yet.
  std::optional<Place> send_tracker(const camera::Frame& frame, const PointingModel& pointing,
                                    const Slew& slew);
  // An object elsewhere that looks like the target is not the one that the other stations see.
  bool is_where_slewed(const camera::Frame& frame, const tracker::TrackerOutput& output,
                       const PointingModel& pointing, const Slew& slew) const;

  // After own_target_s without its own target at the slew, a station acquires whatever is there,
  // like a station without a target: what it was designated may never have been the target.
  bool looks_for_anything(const FollowedTarget& target) const;
  // The box of the object that behaves as the slew predicts in these frames, oldest first.
  std::optional<cv::Rect2d> acquire(const std::deque<camera::Frame>& frames,
                                    const PointingModel& pointing, const Slew& slew);
  // When the trial of an acquired target began; it failed, and the own target is looked for again.
  void begin_trial(double time_s) { searched_s_ = time_s; }
  void end_trial(double time_s);

  // An alarm about a slew to a place known well enough to be in the image; empty: none.
  std::string unacquired_alarm(const Slew& slew) const;
  const std::map<std::string, double>& counters() const { return counters_; }

 private:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  // The time, by frames, during which the slew's place was in the image.
  struct InView {
    double from_s = 0.0, to_s = kNever;
    double own_from_s = kNever;  // since when the own target has been looked for
  };
  struct Expected {  // the slew's target in a frame
    Eigen::Vector2d pixel;
    PanTilt angles;
    // Of a search along a line: its direction, a unit vector; the pixel is its nearest to the
    // middle.
    Eigen::Vector2d line = Eigen::Vector2d::Zero();
  };
  static std::optional<Expected> expected(const camera::Frame& frame, const PointingModel& pointing,
                                          const Slew& slew);
  static std::optional<Expected> expected_in_picture(const camera::Frame& frame,
                                                     const PointingModel& pointing,
                                                     const Slew& slew);
  double search_sd_px(const PointingModel& pointing, const SlewCommand& slew) const;

  const StationConfig config_;
  tracker::Acquisition acquisition_;
  InView in_view_;
  double searched_s_ = 0.0;  // when the tracker was last sent to search
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
