// One camera image, ready for the tracker.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

namespace ols::camera {

enum class StampSource { kCamera, kArrival };

struct Frame {
  cv::Mat gray;                 // 8-bit, one channel
  double mid_exposure_s = 0.0;  // on the station's monotonic clock
  double stamp_sd_s = 0.0;      // 1-sigma of mid_exposure_s
  StampSource stamp_source = StampSource::kCamera;
  // For a rolling shutter: the time from the exposure of the first row to that of the last row;
  // mid_exposure_s is then that of the first row. 0 if all rows are exposed at once.
  double row_readout_s = 0.0;
  std::uint64_t number = 0;  // the camera's frame counter, unwrapped
  // The camera's raw image; empty if it is identical to `gray`, or not needed.
  cv::Mat raw;
  std::string pixel_format = "Mono8";  // GenICam's name of the raw image's format
};

// Mid-exposure time of the row at the distance y_px from the top.
inline double row_time_s(const Frame& frame, double y_px) {
  if (frame.row_readout_s == 0.0) return frame.mid_exposure_s;
  return frame.mid_exposure_s + frame.row_readout_s * y_px / frame.gray.rows;
}

}  // namespace ols::camera
