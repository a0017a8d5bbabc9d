// Pixels of the followed target and of detected objects that wait for the PTU angles of their
// exposure, and the bearings computed from them. Pure.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "edge/frames/pointing_model.h"
#include "edge/station/station_config.h"
#include "edge/station/station_types.h"

namespace ols::station {

// What the detector says of an object besides its pixel.
struct DetectedPixel {
  Eigen::Vector2d velocity_px_s = Eigen::Vector2d::Zero();  // relative to the scene
  double velocity_sd_px_s = 0.0;                            // each axis
  double size_px = 0.0, size_sd_px = 0.0;                   // largest extent
  double signal = 0.0;                                      // to noise
  int image_bearings = 0;                                   // as Bearing has it
};

struct PixelMeasurement {
  double arrived_s = 0.0;
  double mid_exposure_s = 0.0;
  double stamp_sd_s = 0.0;
  camera::StampSource stamp_source = camera::StampSource::kCamera;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();  // white
  double belief = 0.0;
  std::int64_t track_id = 0;
  double designation_sd_px = 0.0;
  std::optional<DetectedPixel> detected{};  // empty: of the followed target
};

struct MadeBearing {
  Bearing bearing;
  PanTilt reported;     // of the unit at the exposure
  bool to_send = true;  // false: no position, or too old; used only to follow the target
};

class BearingQueue {
 public:
  explicit BearingQueue(const StationConfig& config)
      : angle_wait_s_(config.angle_wait_s), max_age_s_(config.max_age_s) {}

  void add(const PixelMeasurement& pixel) { waiting_.push_back(pixel); }
  void clear() { waiting_.clear(); }

  // The pixels whose angles are known, and those that have waited long enough.
  std::vector<MadeBearing> take(const PointingModel& pointing, double now_s);

  // The time from mid-exposure to bearing for the followed target, smoothed.
  double frame_latency_s() const { return frame_latency_s_; }
  const std::map<std::string, double>& counters() const { return counters_; }

 private:
  std::optional<MadeBearing> make(const PixelMeasurement& measured, const PointingModel& pointing);
  bool worth_sending(const Bearing& bearing, const PointingModel& pointing, double now_s);

  double angle_wait_s_;
  double max_age_s_;
  std::deque<PixelMeasurement> waiting_;
  double frame_latency_s_ = 0.0;
  std::map<std::string, double> counters_;
};

}  // namespace ols::station
