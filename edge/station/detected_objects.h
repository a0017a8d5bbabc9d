// Chooses the pictures that a station's detector processes, and handles the objects that the
// detector finds. Pure.
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

// The target that the station follows, in one frame.
struct FollowedBox {
  cv::Rect2d box;
  std::int64_t track_id = 0;
};

// Passes one picture at a time to the detector. When the result of a picture has arrived, the
// newest picture is next. Pictures that were due in between are dropped and counted.
class DetectedObjects {
 public:
  explicit DetectedObjects(const StationConfig& config)
      : config_(config.detection), angle_wait_s_(config.angle_wait_s) {}

  // Takes a frame. Call it only while the mount's angles are trusted. `followed`: the target that
  // the station follows, if this frame gives a bearing of it.
  void on_frame(const camera::Frame& frame, const std::optional<FollowedBox>& followed,
                double now_s);
  // The next picture for the detector, with the motion according to the mount's angles and, if
  // `stars_show`, with the stars' motion. This needs the mount's angles before and after the
  // exposure. nullopt if no picture is due, or if these angles have not arrived yet.
  std::optional<detector::Picture> take(const PointingModel& pointing, double now_s,
                                        bool stars_show = false);
  // Takes the detector's result for the last picture. Returns the pixels of the likeliest confirmed
  // objects in the picture, except the followed target; they become bearings. `new_track_id`:
  // returns an id that no other object of this station has.
  std::vector<PixelMeasurement> on_found(detector::Found found,
                                         const std::function<std::int64_t()>& new_track_id,
                                         double now_s);
  // The frame that the detector is processing; null if there is none, or if forget_angles() has
  // been called since.
  const camera::Frame* looks_at() const {
    return looks_ && !looks_->forgotten ? &looks_->frame : nullptr;
  }
  // What the detector has measured of the followed target in its newest picture; returned once for
  // each picture. nullopt if it found nothing at the target, or if the target followed in that
  // picture had another id. The size in the result follows a bird's wing beats; the tracker's box
  // does not.
  std::optional<DetectedPixel> take_detection_of(std::int64_t track_id);
  // Call when the mount's future angles cannot be compared with earlier ones.
  void forget_angles();

  // The newest result; nullopt before the first one and after forget_angles().
  const std::optional<detector::Found>& newest() const { return newest_; }
  const std::map<std::string, double>& counters() const { return counters_; }

 private:
  struct Look {
    camera::Frame frame;
    std::optional<FollowedBox> followed;
    double arrived_s = 0.0;
    bool forgotten = false;  // forget_angles() was called meanwhile
  };
  std::int64_t track_id(long tracklet, const std::function<std::int64_t()>& new_track_id);
  PixelMeasurement measured(const detector::Tracklet& tracklet, const Look& look) const;
  void note_followed(const Look& look);

  DetectionConfig config_;
  double angle_wait_s_;
  double due_s_ = 0.0;  // the first frame exposed after this time is due
  // The next picture; the picture that the detector is processing.
  std::optional<Look> waiting_, looks_;
  std::optional<double> looked_s_;  // mid-exposure of the last picture passed to the detector
  std::optional<detector::Found> newest_;
  std::optional<DetectedPixel> of_followed_;  // not yet taken
  std::int64_t followed_id_ = 0;
  std::map<long, std::int64_t> track_ids_;  // maps the detector's ids to track_ids
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
