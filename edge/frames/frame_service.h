// Provides full-resolution frames for a calibration, on request. Each frame comes with the unit's
// readings at its exposure, and is taken once the unit stands as requested. Pure.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "edge/camera/frame.h"
#include "edge/frames/exposed_counts.h"
#include "edge/frames/pointing_model.h"

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

struct RequestedFrame {
  FrameRequest request;
  camera::Frame frame;
  ExposedCounts counts;
};

class FrameService {
 public:
  // Returns why the request is refused; empty if it is accepted. Each sender has one request at a
  // time; a newer one replaces it.
  std::string request(const FrameRequest& wanted);
  // Call in order of time.
  void on_frame(const camera::Frame& frame);

  // The answers that are complete: the unit has reported angles before and after the exposure.
  std::vector<RequestedFrame> take(double now_s, const PointingModel& unit);

 private:
  std::deque<camera::Frame> frames_;  // kept only while there is a request
  std::deque<FrameRequest> requests_;
};

}  // namespace ols::station
