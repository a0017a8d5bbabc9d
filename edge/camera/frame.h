// One camera image, ready for the tracker.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

namespace ols::camera {

enum class StampSource { kCamera, kArrival };

struct Frame {
  cv::Mat gray;                 // 8-bit, one channel
  double mid_exposure_s = 0.0;  // station's monotonic clock
  double stamp_sd_s = 0.0;      // 1-sigma of mid_exposure_s
  StampSource stamp_source = StampSource::kCamera;
  std::uint64_t number = 0;  // the camera's frame counter, unwrapped
  // The raw image of the camera; empty where `gray` is identical, or where nobody needs it.
  cv::Mat raw;
  std::string pixel_format = "Mono8";  // GenICam's name of the camera's format
};

}  // namespace ols::camera
