// Operates one opened camera until the camera is lost. Computes the mid-exposure times of the
// frames, monitors the camera's clock and temperature, and controls the exposure.
#pragma once

#include <optional>

#include "edge/camera/aravis/aravis_device.h"
#include "edge/camera/auto_exposure.h"
#include "edge/camera/camera_handover.h"
#include "edge/camera/exposure_log.h"
#include "edge/camera/frame_clock.h"
#include "edge/camera/frame_numbers.h"
#include "edge/camera/frame_statistics.h"

namespace ols::camera {

class AravisSession {
 public:
  // All references must outlive this object. The frame numbers continue from the previous session.
  AravisSession(const AravisConfig& config, AravisDevice& device, FrameNumbers& numbers,
                CameraHandover& handover);

  // Returns when the handover has ended (CameraHandover::end()). Throws CameraAbsent when the
  // camera is lost.
  void stream();

 private:
  void watch(bool received, double turn_s);
  void look();
  void take(const ReceivedFrame& received);
  void choose_exposure(const cv::Mat& gray);
  void change_exposure();

  const AravisConfig& config_;
  const PictureFormat expected_;
  AravisDevice& device_;
  FrameNumbers& numbers_;
  CameraHandover& handover_;
  FrameClock clock_;
  ExposureLog exposures_;
  std::optional<AutoExposure> automatic_;
  std::optional<ExposureSetting> next_exposure_;
  FrameStatistics statistics_;
  double silence_s_ = 0.0;
  double looked_s_ = 0.0;
  int looks_ = 0;
};

}  // namespace ols::camera
