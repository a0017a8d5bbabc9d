// A simulated GigE Vision camera on one local address, its pictures drawn by a callback. One camera
// an address (the control port is fixed).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "tools/sim/faults.h"

namespace ols::sim {

struct CameraServerConfig {
  std::string address;  // an address that the interface really has, for example 127.0.0.11
  std::string serial;   // the device id is "Aravis-Fake-<serial>"
  int width_px = 1280;  // of the sensor
  int height_px = 960;
  double exposure_s = 0.005;  // until the client sets another one
  double readout_s = 0.010;   // the exposure began this much + exposure before the frame is drawn
};

// One exposure to be drawn.
struct Exposure {
  std::int64_t start_realtime_ns = 0;  // CLOCK_REALTIME, also the frame's GigE Vision time stamp
  double exposure_s = 0.0;             // as set by the client at the moment
  std::uint64_t frame = 0;
};

class CameraServer {
 public:
  // `draw` fills the 8-bit one-channel picture (already of the right size, for a Bayer format the
  // raw mosaic); called in the camera's own thread, once a frame, while a client streams. Throws
  // std::system_error when the address cannot be had.
  CameraServer(const CameraServerConfig& config,
               std::function<void(const Exposure&, cv::Mat&)> draw);
  ~CameraServer();

  // The camera forgets the size that the client has set, as after a reset.
  void set_size(int width_px, int height_px);

  // What is wrong with the camera from now on; from any thread.
  void set_faults(const CameraFaults& faults);

  // Exposures that were never made because drawing took too long. Only goes up.
  std::uint64_t skipped() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
