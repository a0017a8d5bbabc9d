// Provides full-resolution frames for a calibration, on request. Each frame comes with the unit's
// readings at its exposure, and is taken once the unit stands as requested. Pure.
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
  std::int64_t boot_id = 0, sequence = 0;  // id of the request
  std::optional<PanTilt> at;               // reported angles; nullopt: wherever the unit stands
  double tolerance_rad = 0.0;
  // How long the unit must have stood still at mid-exposure; 0 if it may move.
  double still_s = 0.0;
  bool lossless = true;
  double expires_s = 0.0;  // on the station's monotonic clock
};

// The unit's readings at one exposure.
struct ExposedCounts {
  double pan = 0.0, tilt = 0.0;      // [counts]
  double pan_s = 0.0, tilt_s = 0.0;  // [counts/s]
  mount::Approach approach;
  PanTilt count;  // size of a count [rad], as the unit reports it
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

  // Sets the size of a count [rad] as the unit reports it. Without it no request can be answered.
  void set_count(const PanTilt& count_rad);
  // Returns why the request is refused; empty if it is accepted. Each sender has one request at a
  // time; a newer one replaces it.
  std::string request(const FrameRequest& wanted);
  // Sets whether the unit's angles can be trusted. While they cannot, samples and frames are
  // dropped and earlier ones forgotten, because later angles will have another zero.
  void set_trusted(bool trusted);
  // Call in order of time.
  void on_angles(const mount::AngleSample& sample);
  void on_frame(const camera::Frame& frame);

  // The answers that are complete: the unit has reported angles before and after the exposure.
  std::vector<RequestedFrame> take(double now_s);
  // nullopt if the unit has not reported angles around that time, or the size of a count is
  // unknown.
  std::optional<ExposedCounts> counts_at(double time_s) const;

 private:
  bool stood(double from_s, double to_s) const;
  bool meets(const FrameRequest& wanted, const camera::Frame& frame,
             const ExposedCounts& counts) const;

  bool trusted_ = false;
  mount::AngleHistory history_;
  mount::ApproachHistory approach_;
  PanTilt count_rad_;
  std::deque<camera::Frame> frames_;  // kept only while there is a request
  std::deque<FrameRequest> requests_;
};

}  // namespace ols::station
