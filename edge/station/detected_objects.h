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

// One picture at a time: the next one is given when the last one's result has come. It is then the
// newest; those that were due meanwhile are dropped and counted.
class DetectedObjects {
 public:
  explicit DetectedObjects(const StationConfig& config)
      : config_(config.detection), angle_wait_s_(config.angle_wait_s) {}

  // A frame while the mount is sure of its angles. `followed`: the box of the station's own target
  // in it, if this frame gives a bearing of the target.
  void on_frame(const camera::Frame& frame, const std::optional<cv::Rect2d>& followed,
                double now_s);
  // The picture to be looked at now, with the mount's motion by its angles before and after the
  // exposure; empty: none is due, or the angles are still to come.
  std::optional<detector::Picture> take(const PointingModel& pointing, double now_s);
  // The result of the picture that was taken last. Returns the pixels that become bearings: of the
  // confirmed objects that the picture shows, without the followed target, the likeliest ones.
  // `new_track_id` gives an id that no other object of this station has.
  std::vector<PixelMeasurement> on_found(detector::Found found,
                                         const std::function<std::int64_t()>& new_track_id,
                                         double now_s);
  // Earlier angles are not comparable with later ones.
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
  double due_s_ = 0.0;                   // mid-exposure from which a frame is due
  std::optional<Look> waiting_, looks_;  // the next picture, the one being looked at
  std::optional<double> looked_s_;       // mid-exposure of the last one given
  std::optional<detector::Found> newest_;
  std::map<long, std::int64_t> track_ids_;  // by the detector's id
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
