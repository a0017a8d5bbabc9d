// A simulated GigE Vision camera on one local address, its pictures drawn by a callback. One camera
// an address (the control port is fixed).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "sim/faults.h"
#include "sim/gige_description.h"

namespace ols::sim {

struct CameraServerConfig {
  std::string address;  // an address that the interface really has, for example 127.0.0.11
  std::string serial;   // the device id is "AVT-<serial>"
  int width_px = 1280;  // of the sensor
  int height_px = 960;
  double exposure_s = 0.005;  // until the client sets another one
  double readout_s = 0.010;   // the exposure began this much + exposure before the frame is drawn

  gige::FeatureNames names = gige::FeatureNames::kGt1290c;
  bool tick_frequency = true;     // false: its register reads 0, as some firmware has it
  double clock_drift_ppm = 20.0;  // of the camera's own clock, which begins near 0
  double tai_minus_utc_s = 37.0;  // of the PTP master, whose UTC is the host's
};

// One exposure to be drawn.
struct Exposure {
  std::int64_t start_monotonic_ns = 0;  // CLOCK_MONOTONIC
  double exposure_s = 0.0;              // as set by the client at the moment
  double gain_dB = 0.0;                 // likewise
  std::uint64_t frame = 0;
};

class CameraServer {
 public:
  // `draw` fills the 8-bit gray picture, which is already of the right size; in a Bayer or RGB
  // format the camera sends it as a scene of a slightly warm colour (kTint). Called in the camera's
  // own thread, once a frame, while a client streams. Throws std::system_error when the address
  // cannot be had.
  CameraServer(const CameraServerConfig& config,
               std::function<void(const Exposure&, cv::Mat&)> draw);
  ~CameraServer();

  // Of red, green and blue before gray.
  static constexpr std::array<double, 3> kTint = {1.0, 0.9, 0.7};

  // A pulse on one of the lines 1 to 4: an exposure, if the camera waits for one on that line.
  void pulse(int line);

  // The camera forgets the size that the client has set, as after a reset.
  void set_size(int width_px, int height_px);
  // It is off and on again, without a moment in which it answers nothing.
  void power_cycle();

  // What is wrong with the camera from now on; from any thread.
  void set_faults(const CameraFaults& faults);

  // Exposures that were never made because drawing took too long. Only goes up.
  std::uint64_t skipped() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
