// One opened camera, from its first frame until it is lost. Computes the times of its frames,
// monitors its clock and temperature, and sets its exposure.
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
  // All references must outlive this object. Frame numbers continue those of the previous session.
  AravisSession(const AravisConfig& config, AravisDevice& device, FrameNumbers& numbers,
                CameraHandover& handover);

  // Runs until the camera's thread is to end. Throws CameraAbsent when the camera is lost.
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
