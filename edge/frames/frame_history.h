// The frames of the last few seconds. They are needed because an operator may designate in an image
// that is not the newest, and because acquisition compares images. The memory is limited by the
// span: at 1280 x 960 and 30 Hz, a second takes 37 MB in grey, and as much again with a Bayer
// mosaic. Pure.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "edge/camera/frame.h"

namespace ols::station {

class FrameHistory {
 public:
  explicit FrameHistory(double span_s) : span_s_(span_s) {}

  // Returns false if the frame was ignored because it is not later than the newest.
  bool add(const camera::Frame& frame);
  // Finds the frame of an instant; if none is given, the newest frame. Null if there is no such
  // frame.
  const camera::Frame* find(const std::optional<double>& mid_exposure_s) const;
  // The frames after this instant, oldest first, including the newest. If there are more than
  // kMostSince, only every second (third, ...) one. The limit is needed because the control loop
  // waits while they are processed.
  std::vector<const camera::Frame*> since(double mid_exposure_s) const;
  static constexpr std::size_t kMostSince = 33;
  // All frames, oldest first.
  const std::deque<camera::Frame>& frames() const { return frames_; }

 private:
  double span_s_;
  std::deque<camera::Frame> frames_;
};

}  // namespace ols::station
