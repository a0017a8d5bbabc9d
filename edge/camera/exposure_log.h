// For how long a frame was exposed, when the exposure is changed in mid-stream. Pure.
//
// The camera says nowhere with which setting a frame was made (a GT1290C's chunk data cannot be
// switched while it streams). So: a frame that began before the change was asked for has the old
// one; one that began more than a frame period after it was granted has the new one, because the
// next exposure may already be set up when it comes; in between it may be either.
#pragma once

#include <deque>

namespace ols::camera {

struct ExposureUsed {
  double exposure_s = 0.0;
  double sd_s = 0.0;  // 1-sigma; 0 when it is known
};

class ExposureLog {
 public:
  // `first_s`: the exposure from the beginning on.
  ExposureLog(double first_s, double frame_period_s)
      : first_s_(first_s), frame_period_s_(frame_period_s) {}

  // A new exposure was asked for and granted at these instants (CLOCK_MONOTONIC).
  void change(double asked_s, double granted_s, double exposure_s);

  double newest_s() const { return changes_.empty() ? first_s_ : changes_.back().exposure_s; }

  // Of the frame whose exposure began at `start_s`.
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
