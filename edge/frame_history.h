// The frames of the last second: an operator designates in a picture that is older than the newest,
// and a search compares pictures. Pure.
#pragma once

#include <deque>
#include <optional>

#include "edge/camera/frame.h"

namespace ols::station {

class FrameHistory {
 public:
  explicit FrameHistory(double span_s) : span_s_(span_s) {}

  // False: not later than the newest one, and left out.
  bool add(const camera::Frame& frame);
  // Nothing designated: the newest. Null when there is none at that instant.
  const camera::Frame* find(const std::optional<double>& mid_exposure_s) const;
  // Oldest first.
  const std::deque<camera::Frame>& frames() const { return frames_; }

 private:
  double span_s_;
  std::deque<camera::Frame> frames_;
};

}  // namespace ols::station
