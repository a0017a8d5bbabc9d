// Where and how a slewed station looks for its target: with the template of an earlier track, or
// for anything that behaves as the slew says. Pure.
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
  // Where the tracker shall be sent to look for its target now. Nothing: it was sent a moment ago,
  // or the PTU is still on its way.
  std::optional<Place> send_tracker(const camera::Frame& frame, const PointingModel& pointing,
                                    const Slew& slew);
  // What looks like the target elsewhere is not the one that the others see there.
  bool is_where_slewed(const camera::Frame& frame, const tracker::TrackerOutput& output,
                       const PointingModel& pointing, const Slew& slew) const;

  // A slewed station that has not found its own target for own_target_s where the slews lead looks
  // for whatever is there, as one without a target does: what it was told to follow may never have
  // been the target.
  bool looks_for_anything(const FollowedTarget& target) const;
  // The box of what behaves as the slew says in these frames, the newest last.
  std::optional<cv::Rect2d> acquire(const std::deque<camera::Frame>& frames,
                                    const PointingModel& pointing, const Slew& slew);
  // What was acquired is on trial since this instant; it was not believed in, and the own target
  // has its turn again.
  void begin_trial(double time_s) { searched_s_ = time_s; }
  void end_trial(double time_s);

  // An alarm about a slew to a place that is known well enough to be in the picture; else empty.
  std::string unacquired_alarm(const Slew& slew) const;
  const std::map<std::string, double>& counters() const { return counters_; }

 private:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  // The time in which a slew has led to a place that is in the picture, by frames.
  struct InView {
    double from_s = 0.0, to_s = kNever;
    double own_from_s = kNever;  // since when it has been the own target that is looked for
  };
  struct Expected {  // of the slew's target in a frame
    Eigen::Vector2d pixel;
    PanTilt angles;
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
  double searched_s_ = 0.0;  // when the tracker was last told where to search
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
