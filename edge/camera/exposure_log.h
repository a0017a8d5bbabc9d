// Determines the exposure time of each frame while the exposure changes from time to time. Pure.
//
// The camera does not report the exposure of a frame: a GT1290C cannot switch on its chunk data
// while it streams. A frame that began before a change was requested has the old exposure. A frame
// that began more than a frame period after the camera confirmed the change has the new one. For
// frames in between, both are possible, because the camera may have prepared its next exposure
// before the change.
#pragma once

#include <deque>

namespace ols::camera {

struct ExposureUsed {
  double exposure_s = 0.0;
  double sd_s = 0.0;  // 1-sigma; 0 if known exactly
};

class ExposureLog {
 public:
  // `first_s`: the exposure at the start.
  ExposureLog(double first_s, double frame_period_s)
      : first_s_(first_s), frame_period_s_(frame_period_s) {}

  // Notes a change: the new exposure, and the instants (CLOCK_MONOTONIC) at which it was requested
  // and confirmed.
  void change(double asked_s, double granted_s, double exposure_s);

  double newest_s() const { return changes_.empty() ? first_s_ : changes_.back().exposure_s; }

  // The exposure of the frame that began at `start_s`. If two are possible, the result is their
  // mean.
  ExposureUsed at(double start_s) const;

 private:
  struct Change {
    double asked_s, granted_s, exposure_s;
  };
  double first_s_;
  double frame_period_s_;
  std::deque<Change> changes_;
};

}  // namespace ols::camera
