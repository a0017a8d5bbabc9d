// What the detector of a station looks at, and what becomes of the objects that it finds. Pure.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "edge/camera/frame.h"
#include "edge/detector/detector_work.h"
#include "edge/frames/pointing_model.h"
#include "edge/station/bearing_queue.h"
#include "edge/station/station_config.h"

namespace ols::station {

// Gives one picture at a time. When the result of a picture has come, it gives the newest picture;
// pictures that were due in between are dropped and counted.
class DetectedObjects {
 public:
  explicit DetectedObjects(const StationConfig& config)
      : config_(config.detection), angle_wait_s_(config.angle_wait_s) {}

  // Takes a frame, while the mount is sure of its angles. `followed`: the box of the station's own
  // target in the frame, if the frame gives a bearing of that target.
  void on_frame(const camera::Frame& frame, const std::optional<cv::Rect2d>& followed,
                double now_s);
  // The picture to be looked at now, and the mount's motion, from its angles before and after the
  // exposure. Empty: no picture is due, or the angles have not come yet.
  std::optional<detector::Picture> take(const PointingModel& pointing, double now_s);
  // Takes the result of the last picture. Returns the pixels that become bearings: those of the
  // likeliest confirmed objects in the picture, without the followed target. `new_track_id` gives
  // an id that no other object of this station has.
  std::vector<PixelMeasurement> on_found(detector::Found found,
                                         const std::function<std::int64_t()>& new_track_id,
                                         double now_s);
  // From now on, angles are not comparable with earlier ones.
  void forget_angles();

  // The newest result; empty before the first, and while angles are forgotten.
  const std::optional<detector::Found>& newest() const { return newest_; }
  const std::map<std::string, double>& counters() const { return counters_; }

 private:
  struct Look {
    camera::Frame frame;
    std::optional<cv::Rect2d> followed;
    double arrived_s = 0.0;
    bool forgotten = false;  // its angles
  };
  std::int64_t track_id(long tracklet, const std::function<std::int64_t()>& new_track_id);
  PixelMeasurement measured(const detector::Tracklet& tracklet, const Look& look) const;

  DetectionConfig config_;
  double angle_wait_s_;
  double due_s_ = 0.0;                   // the first frame with a later mid-exposure is due
  std::optional<Look> waiting_, looks_;  // the next picture, the one being looked at
  std::optional<double> looked_s_;       // mid-exposure of the last picture given
  std::optional<detector::Found> newest_;
  std::map<long, std::int64_t> track_ids_;  // by the detector's id
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
