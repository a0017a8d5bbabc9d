// Decides where and how a slewed station searches. The station searches for its own target by
// appearance, or for any object that moves as the slew predicts. Pure.
#pragma once

#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "conditions/alarm.h"
#include "edge/camera/frame.h"
#include "edge/detector/detector_work.h"
#include "edge/frames/pointing_model.h"
#include "edge/station/followed_target.h"
#include "edge/station/station_config.h"
#include "edge/station/station_types.h"
#include "edge/tracker/acquisition.h"

namespace ols::station {

class SlewSearch {
 public:
  using Slew = std::optional<SlewCommand>;

  explicit SlewSearch(const StationConfig& config)
      : config_(config), acquisition_(config.acquisition) {}

  // Call when the station enters another state. `found`: the station now tracks something.
  void restart(bool found);
  // Call with each frame while the station is slewed.
  void note_in_view(const camera::Frame& frame, const PointingModel& pointing, const Slew& slew);

  struct Place {
    Eigen::Vector2d pixel;
    double sd_px = 0.0;
  };
  // The place where the tracker must search for its target. nullopt if the tracker has got a place
  // within the last search_interval_s, or if the place is not in the picture yet.
  std::optional<Place> send_tracker(const camera::Frame& frame, const PointingModel& pointing,
                                    const Slew& slew);
  // Whether the tracker's object is near the place to which the station is slewed. A similar object
  // elsewhere is not the object that the other stations see.
  bool is_where_slewed(const camera::Frame& frame, const tracker::TrackerOutput& output,
                       const PointingModel& pointing, const Slew& slew) const;

  // Whether the station may acquire any object at the place where the slew points. A station
  // without a target may do so. A station with a target may do so if it has not found its target
  // there for own_target_s, because the designation may have been wrong.
  bool looks_for_anything(const FollowedTarget& target) const;
  struct Acquired {
    const camera::Frame* frame;  // one of the frames passed to acquire()
    cv::Rect2d box;              // box of the object in that frame
    bool by_tracklet = false;    // found by the detector
  };
  // Finds an object that moves as the slew predicts. If exactly one confirmed object of the
  // detector does so, that object is returned. Otherwise, tracker::Acquisition searches the frames.
  // `frames`: oldest first.
  std::optional<Acquired> acquire(const std::deque<camera::Frame>& frames,
                                  const std::optional<detector::Found>& found,
                                  const PointingModel& pointing, const Slew& slew);
  // begin_trial(): call when the trial of an acquired target begins. end_trial(): call when the
  // trial has failed, and the station searches for its own target again.
  void begin_trial(const Acquired& target);
  void end_trial(double time_s);

  // The alarm that nothing is acquired, although the place where the slew points has been in the
  // image for unacquired_alarm_s. Empty otherwise, and also if the place is so uncertain that the
  // target may be outside the image.
  Alarm unacquired_alarm(const Slew& slew) const;
  const std::map<std::string, double>& counters() const { return counters_; }

 private:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  // The times of the first and of the last frame that showed the place where the slew points.
  struct InView {
    double from_s = 0.0, to_s = kNever;
    double own_from_s = kNever;  // start of the search for the own target
  };
  struct Expected {  // where the slew's target is expected in a frame
    Eigen::Vector2d pixel;
    PanTilt angles;
    // For a search along a line: the line's direction in the image, a unit vector; `pixel` is then
    // the point of the line nearest to the image's middle. Otherwise zero.
    Eigen::Vector2d line = Eigen::Vector2d::Zero();
  };
  static std::optional<Expected> expected(const camera::Frame& frame, const PointingModel& pointing,
                                          const Slew& slew);
  static std::optional<Expected> expected_in_picture(const camera::Frame& frame,
                                                     const PointingModel& pointing,
                                                     const Slew& slew);
  double search_sd_px(const PointingModel& pointing, const SlewCommand& slew) const;
  std::optional<Acquired> choose(const std::deque<camera::Frame>& frames,
                                 const detector::Found& found, const PointingModel& pointing,
                                 const Slew& slew) const;
  bool behaves(const detector::Tracklet& tracklet, const camera::Frame& frame,
               const PointingModel& pointing, const Slew& slew) const;
  std::optional<cv::Rect2d> look(const std::deque<camera::Frame>& frames,
                                 const PointingModel& pointing, const Slew& slew);

  const StationConfig config_;
  tracker::Acquisition acquisition_;
  InView in_view_;
  double searched_s_ = 0.0;  // time at which the tracker last got a place
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
