// A simulated GigE Vision camera on one local address. A callback draws its images. Each camera
// needs an address of its own, because the standard fixes the control port.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "sim/camera/gige_description.h"
#include "sim/scenario/faults.h"

namespace ols::sim {

struct SimulatedCameraConfig {
  std::string address;  // one that an interface of this host has, for example 127.0.0.11
  std::string serial;   // the device id is "AVT-<serial>"
  int width_px = 1280;  // of the sensor
  int height_px = 960;
  double exposure_s = 0.005;  // until the client sets another one
  double readout_s = 0.010;   // from the end of the exposure to the drawing of the frame

  gige::FeatureNames names = gige::FeatureNames::kGt1290c;
  // False: the register of the tick frequency reads 0, as in some firmware.
  bool tick_frequency = true;
  double clock_drift_ppm = 20.0;  // of the camera's own clock, which starts near 0
  double tai_minus_utc_s = 37.0;  // of the PTP master, whose UTC is the host's clock
};

// One exposure to draw.
struct Exposure {
  std::int64_t start_monotonic_ns = 0;  // CLOCK_MONOTONIC
  double exposure_s = 0.0;              // as the client has set it
  double gain_dB = 0.0;                 // likewise
  std::uint64_t frame = 0;
};

class SimulatedCamera {
 public:
  // `draw` fills an 8-bit gray image of the right size. It is called in the camera's own thread,
  // once per frame, while a client streams. In a Bayer or RGB format the camera sends a slightly
  // warm colour (kTint). Throws std::system_error if the address is not available.
  SimulatedCamera(const SimulatedCameraConfig& config,
                  std::function<void(const Exposure&, cv::Mat&)> draw);
  ~SimulatedCamera();

  // Factors of red, green and blue on gray.
  static constexpr std::array<double, 3> kTint = {1.0, 0.9, 0.7};

  // Puts a pulse on one of the lines 1 to 4. If the camera waits for a trigger on that line, it
  // exposes.
  void pulse(int line);

  // The camera forgets the size set by the client, as after a reset.
  void set_size(int width_px, int height_px);
  // Switches the camera off and on: it loses its settings. Unlike a real camera, it answers all the
  // time.
  void power_cycle();

  // Faults of the camera from now on; from any thread.
  void set_faults(const CameraFaults& faults);

  // Number of exposures skipped because drawing took too long. Only increases.
  std::uint64_t skipped() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
