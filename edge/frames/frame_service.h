// Provides full-resolution frames for a calibration, on request. A request states the angles and
// the rest of the unit; the first frame exposed under these conditions answers it. The frame comes
// with the unit's readings at its exposure. Pure.
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
  std::int64_t boot_id = 0, sequence = 0;  // they identify the request
  std::optional<PanTilt> at;  // reported angles at which to take the frame; nullopt: any
  double tolerance_rad = 0.0;
  // How long the unit must have been at rest before mid-exposure; 0 means that it may move.
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
  // Call in the order of the frames' times.
  void on_frame(const camera::Frame& frame);

  // The frames that answer a request, once the unit has reported angles before and after their
  // exposure. Requests that have expired are dropped.
  std::vector<RequestedFrame> take(double now_s, const PointingModel& unit);

 private:
  std::deque<camera::Frame> frames_;  // kept only while there is a request
  std::deque<FrameRequest> requests_;
};

}  // namespace ols::station
