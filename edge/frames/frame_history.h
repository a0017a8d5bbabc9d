// The frames of the last seconds. They are needed because an operator designates in an image that
// is not the newest, and because acquisition compares images. Limited by its span: at 1280 x 960
// and 30 Hz a second takes 37 MB in grey, and as much again with a Bayer mosaic. Pure.
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

  // Returns false if the frame was ignored, because it is not later than the newest.
  bool add(const camera::Frame& frame);
  // Without a time: the newest frame. Null: no frame of that instant.
  const camera::Frame* find(const std::optional<double>& mid_exposure_s) const;
  // The frames after this instant, oldest first, including the newest: all of them, or every
  // second, third, ... so that there are at most kMostSince. The limit is needed because the
  // control loop waits while they are processed.
  std::vector<const camera::Frame*> since(double mid_exposure_s) const;
  static constexpr std::size_t kMostSince = 33;
  // All frames, oldest first.
  const std::deque<camera::Frame>& frames() const { return frames_; }

 private:
  double span_s_;
  std::deque<camera::Frame> frames_;
};

}  // namespace ols::station
