// Keeps the frames of the last few seconds. They are needed because an operator may designate an
// object in an image that is not the newest, and because acquisition compares images. The span
// limits the memory: at 1280 x 960 and 30 Hz, a second of grey frames takes 37 MB; a Bayer mosaic
// doubles this. Pure.
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

  // Returns false, and ignores the frame, if it is not later than the newest one.
  bool add(const camera::Frame& frame);
  // The frame whose mid-exposure is nearest to this time, if the two differ by less than 20 ms;
  // without a time, the newest frame. Null if there is no such frame.
  const camera::Frame* find(const std::optional<double>& mid_exposure_s) const;
  // The frames after this time up to the newest, oldest first. If there are more than kMostSince,
  // only every second (third, ...) frame is returned, because the control loop waits while they are
  // processed.
  std::vector<const camera::Frame*> since(double mid_exposure_s) const;
  static constexpr std::size_t kMostSince = 33;
  // All frames, oldest first.
  const std::deque<camera::Frame>& frames() const { return frames_; }

 private:
  double span_s_;
  std::deque<camera::Frame> frames_;
};

}  // namespace ols::station
