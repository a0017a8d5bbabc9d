// Keeps pixels of the followed target and of detected objects until the PTU angles at their
// exposure are known. Then computes bearings from them. Pure.
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

// What the detector has measured of an object besides its pixel.
struct DetectedPixel {
  // False if this is the followed target; velocity and image_bearings are then not set.
  bool is_tracklet = true;
  Eigen::Vector2d velocity_px_s = Eigen::Vector2d::Zero();  // relative to the scene
  double velocity_sd_px_s = 0.0;                            // 1-sigma, each axis
  double size_px = 0.0, size_sd_px = 0.0;                   // longer side of its upright box
  double across_px = 0.0;                                   // shorter side of that box
  // 1-sigma of the random part of size_px's error, which is independent from image to image; 0 if
  // unknown.
  double size_noise_px = 0.0;
  double signal = 0.0;     // signal-to-noise ratio
  int image_bearings = 0;  // DetectedObject::image_bearings
};

struct PixelMeasurement {
  double arrived_s = 0.0;
  double mid_exposure_s = 0.0;
  double stamp_sd_s = 0.0;
  camera::StampSource stamp_source = camera::StampSource::kCamera;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();  // white part
  double belief = 0.0;
  std::int64_t track_id = 0;
  double designation_sd_px = 0.0;
  bool acquired = false;  // Bearing::acquired
  std::optional<DetectedPixel> detected{};
};

struct MadeBearing {
  Bearing bearing;
  PanTilt reported;  // the angles that the unit reported for the exposure
  // False if the station has no position, or if the bearing is too old. The bearing is then used
  // only to follow the target.
  bool to_send = true;
};

class BearingQueue {
 public:
  explicit BearingQueue(const StationConfig& config)
      : angle_wait_s_(config.angle_wait_s), max_age_s_(config.max_age_s) {}

  void add(const PixelMeasurement& pixel) { waiting_.push_back(pixel); }
  void clear() { waiting_.clear(); }

  // Returns the bearings of all pixels whose angles are known. After `angle_wait_s`, extrapolated
  // angles are used.
  std::vector<MadeBearing> take(const PointingModel& pointing, double now_s);

  // The smoothed time [s] from mid-exposure to the bearing of the followed target.
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
