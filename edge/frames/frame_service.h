// Full-resolution frames for a calibration, on request. Each has the unit's readings at its
// exposure, and is taken once the unit stands as requested. Pure.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "edge/camera/frame.h"
#include "edge/mount/angle_history.h"
#include "edge/mount/approach_history.h"

namespace ols::station {

struct FrameRequest {
  std::int64_t boot_id = 0, sequence = 0;  // of the request
  std::optional<PanTilt> at;               // reported angles; nullopt: wherever the unit stands
  double tolerance_rad = 0.0;
  double still_s = 0.0;  // how long the unit must have stood at mid-exposure; 0: it may move
  bool lossless = true;
  double expires_s = 0.0;  // station's monotonic clock
};

// The unit's readings at one exposure.
struct ExposedCounts {
  double pan = 0.0, tilt = 0.0;      // [counts]
  double pan_s = 0.0, tilt_s = 0.0;  // [counts/s]
  mount::Approach approach;
  PanTilt count;  // [rad] as the unit reports it
};

struct RequestedFrame {
  FrameRequest request;
  camera::Frame frame;
  ExposedCounts counts;
};

class FrameService {
 public:
  explicit FrameService(const mount::AngleHistory::Config& history)
      : history_(history), approach_({history.step_rad, history.step_rad}) {}

  // The size of a count [rad] as the unit reports it; without it no request can be answered.
  void set_count(const PanTilt& count_rad);
  // Returns why the request is refused; empty: accepted. A sender has one request at a time; a
  // newer request replaces it.
  std::string request(const FrameRequest& wanted);
  // Whether angles are in the unit's reference. While they are not, samples and frames are dropped,
  // and earlier ones are forgotten, because later ones will be in another frame of reference.
  void set_trusted(bool trusted);
  // In time order.
  void on_angles(const mount::AngleSample& sample);
  void on_frame(const camera::Frame& frame);

  // The complete answers: the unit has reported angles before and after the exposure.
  std::vector<RequestedFrame> take(double now_s);
  // nullopt: the unit has not reported such angles, or the size of a count is unknown.
  std::optional<ExposedCounts> counts_at(double time_s) const;

 private:
  bool stood(double from_s, double to_s) const;
  bool meets(const FrameRequest& wanted, const camera::Frame& frame,
             const ExposedCounts& counts) const;

  bool trusted_ = false;
  mount::AngleHistory history_;
  mount::ApproachHistory approach_;
  PanTilt count_rad_;
  std::deque<camera::Frame> frames_;  // kept while there is a request
  std::deque<FrameRequest> requests_;
};

}  // namespace ols::station
