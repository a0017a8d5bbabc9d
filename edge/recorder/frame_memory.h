// Keeps the frames of the last few seconds, up to a number of bytes. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "edge/camera/frame.h"

namespace ols::recorder {

struct RecordedFrame {
  cv::Mat picture;                     // the camera's raw image
  std::string pixel_format = "Mono8";  // GenICam's name of the picture's format
  std::int64_t utime_us = 0;           // mid-exposure
  double mid_exposure_s = 0.0;         // on the station's monotonic clock
  double sd_s = 0.0;                   // 1-sigma of mid_exposure_s
  camera::StampSource stamp_source = camera::StampSource::kCamera;
  std::uint64_t number = 0;
};

std::size_t bytes_of(const RecordedFrame& frame);

class FrameMemory {
 public:
  FrameMemory(double span_s, double most_bytes) : span_s_(span_s), most_bytes_(most_bytes) {}

  void add(const RecordedFrame& frame);
  // The frames with mid_exposure_s from `from_s` to `to_s` (both included), oldest first.
  std::vector<RecordedFrame> between(double from_s, double to_s) const;
  const std::deque<RecordedFrame>& frames() const { return frames_; }
  std::size_t bytes() const { return bytes_; }

 private:
  double span_s_;
  double most_bytes_;
  std::deque<RecordedFrame> frames_;
  std::size_t bytes_ = 0;
};

}  // namespace ols::recorder
