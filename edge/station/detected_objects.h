// Chooses the pictures that a station's detector looks at, and handles the objects that it finds.
// Pure.
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

// The station's own target in a frame.
struct FollowedBox {
  cv::Rect2d box;
  std::int64_t track_id = 0;
};

// It passes one picture at a time to the detector. When the result of a picture has arrived, the
// newest picture follows; pictures that were due in between are dropped and counted.
class DetectedObjects {
 public:
  explicit DetectedObjects(const StationConfig& config)
      : config_(config.detection), angle_wait_s_(config.angle_wait_s) {}

  // Takes a frame. Call it only while the mount's angles are trusted. `followed`: the station's own
  // target, if the frame gives a bearing of that target.
  void on_frame(const camera::Frame& frame, const std::optional<FollowedBox>& followed,
                double now_s);
  // The next picture for the detector, with the mount's motion and, if stars show, with theirs. The
  // motion needs the mount's angles before and after the exposure. nullopt if no picture is due, or
  // if those angles have not arrived yet.
  std::optional<detector::Picture> take(const PointingModel& pointing, double now_s,
                                        bool stars_show = false);
  // Takes the result of the last picture. Returns the pixels that become bearings: those of the
  // likeliest confirmed objects in the picture, except the followed target. `new_track_id` returns
  // an id that no other object of this station has.
  std::vector<PixelMeasurement> on_found(detector::Found found,
                                         const std::function<std::int64_t()>& new_track_id,
                                         double now_s);
  // The frame that the detector looks at; null if there is none, or if its angles were forgotten.
  const camera::Frame* looks_at() const {
    return looks_ && !looks_->forgotten ? &looks_->frame : nullptr;
  }
  // What the newest picture shows of the followed target; returned once for each picture. nullopt
  // if it shows nothing, or if the target followed in that picture had another id. The size changes
  // with a bird's wings; the tracker's box does not.
  std::optional<DetectedPixel> take_detection_of(std::int64_t track_id);
  // Call when angles from now on are not comparable with earlier ones.
  void forget_angles();

  // The newest result; nullopt before the first one and after forget_angles().
  const std::optional<detector::Found>& newest() const { return newest_; }
  const std::map<std::string, double>& counters() const { return counters_; }

 private:
  struct Look {
    camera::Frame frame;
    std::optional<FollowedBox> followed;
    double arrived_s = 0.0;
    bool forgotten = false;  // its angles were forgotten
  };
  std::int64_t track_id(long tracklet, const std::function<std::int64_t()>& new_track_id);
  PixelMeasurement measured(const detector::Tracklet& tracklet, const Look& look) const;
  void note_followed(const Look& look);

  DetectionConfig config_;
  double angle_wait_s_;
  double due_s_ = 0.0;  // the next frame exposed after this instant is for the detector
  std::optional<Look> waiting_, looks_;  // the next picture; the picture being looked at
  std::optional<double> looked_s_;       // mid-exposure of the last picture passed on
  std::optional<detector::Found> newest_;
  std::optional<DetectedPixel> of_followed_;  // not yet taken
  std::int64_t followed_id_ = 0;
  std::map<long, std::int64_t> track_ids_;  // by the detector's own id
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
