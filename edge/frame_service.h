// Frames at full resolution for a calibration, on request: each with what the unit reported at its
// exposure, once the unit stands as asked. Pure.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "edge/camera/frame.h"
#include "edge/ptu/angle_history.h"
#include "edge/ptu/approach_history.h"

namespace ols::station {

struct FrameRequest {
  std::int64_t boot_id = 0, sequence = 0;  // of the request
  std::optional<PanTilt> at;               // reported angles; empty: wherever it stands
  double tolerance_rad = 0.0;
  double still_s = 0.0;  // the unit has stood so long at mid-exposure; 0: it may move
  bool lossless = true;
  double expires_s = 0.0;  // station's monotonic clock
};

// What the unit reported of one exposure.
struct ExposedCounts {
  double pan = 0.0, tilt = 0.0;      // [counts]
  double pan_s = 0.0, tilt_s = 0.0;  // [counts/s]
  ptu::Approach approach;
  PanTilt count;  // [rad] as the unit says
};

struct RequestedFrame {
  FrameRequest request;
  camera::Frame frame;
  ExposedCounts counts;
};

class FrameService {
 public:
  explicit FrameService(const ptu::AngleHistory::Config& history)
      : history_(history), approach_({history.step_rad, history.step_rad}) {}

  // What the unit says that a count is [rad]; without it no request can be answered.
  void set_count(const PanTilt& count_rad);
  // Empty: accepted; otherwise why not. A sender has one request at a time: a newer one replaces
  // it.
  std::string request(const FrameRequest& wanted);
  // Whether angles are in the unit's reference. Until they are, samples and frames are dropped;
  // those of before are forgotten: earlier and later ones are not in the same frame of reference.
  void set_trusted(bool trusted);
  // In time order.
  void on_angles(const ptu::AngleSample& sample);
  void on_frame(const camera::Frame& frame);

  // The answers that are complete: the unit has reported angles on both sides of the exposure.
  std::vector<RequestedFrame> take(double now_s);
  // Nothing where it has not, or where nobody knows what a count is.
  std::optional<ExposedCounts> counts_at(double time_s) const;

 private:
  bool stood(double from_s, double to_s) const;
  bool meets(const FrameRequest& wanted, const camera::Frame& frame,
             const ExposedCounts& counts) const;

  bool trusted_ = false;
  ptu::AngleHistory history_;
  ptu::ApproachHistory approach_;
  PanTilt count_rad_;
  std::deque<camera::Frame> frames_;  // while anything is asked for
  std::deque<FrameRequest> requests_;
};

}  // namespace ols::station
