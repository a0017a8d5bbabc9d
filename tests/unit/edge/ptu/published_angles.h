// Compares angles with the truth, at the times at which a station publishes them. The camera has 15
// Hz. The angles of an exposure are computed when there are samples before and after it, or at the
// latest after a short wait.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "edge/mount/angle_history.h"
#include "tests/unit/edge/ptu/closed_loop.h"

namespace ols::ptu {

class PublishedAngles {
 public:
  explicit PublishedAngles(const mount::AngleHistory::Config& config) : history_(config) {}

  // Call once in each tick of the loop.
  void step(ClosedLoop& loop) {
    constexpr double kFrame_s = 1.0 / 15.0, kArrival_s = 0.02, kWait_s = 0.03;
    for (const mount::AngleSample& sample : loop.driver.take_samples())
      EXPECT_TRUE(history_.add(sample));
    if (loop.time_s >= next_exposure_s_) {
      next_exposure_s_ = std::max(next_exposure_s_, loop.time_s) + kFrame_s;
      exposures_.push_back(loop.time_s);
    }
    while (!exposures_.empty() && loop.time_s >= exposures_.front() + kArrival_s) {
      const double mid_s = exposures_.front();
      const auto at = history_.at(mid_s);
      const bool bracketed = at && at->interpolated;
      if (!bracketed && loop.time_s < mid_s + kArrival_s + kWait_s) break;
      exposures_.pop_front();
      if (at) {
        judge(*at, loop.unit.angles_at(mid_s));
      } else {
        ++withheld;
      }
    }
  }

  double nees() const { return nees_sum_ / (2.0 * published); }
  double pan_nees() const { return pan_nees_sum_ / published; }
  double rms_deg() const { return degrees(std::sqrt(square_sum_ / published)); }

  int published = 0, withheld = 0;
  int beyond_three = 0;  // errors beyond three sigmas, of both axes
  double worst_sigmas = 0.0;
  double worst_deg = 0.0;

 private:
  void judge(const mount::AngleAt& at, const PanTilt& truth) {
    const double pan = at.angles.pan_rad - truth.pan_rad;
    const double tilt = at.angles.tilt_rad - truth.tilt_rad;
    ++published;
    square_sum_ += pan * pan;
    pan_nees_sum_ += pan * pan / at.covariance(0, 0);
    for (const auto& [error, variance] :
         {std::pair(pan, at.covariance(0, 0)), std::pair(tilt, at.covariance(1, 1))}) {
      const double sigmas = std::abs(error) / std::sqrt(variance);
      nees_sum_ += sigmas * sigmas;
      beyond_three += sigmas > 3.0 ? 1 : 0;
      worst_sigmas = std::max(worst_sigmas, sigmas);
      worst_deg = std::max(worst_deg, degrees(std::abs(error)));
    }
  }

  mount::AngleHistory history_;
  std::deque<double> exposures_;
  double next_exposure_s_ = 0.0;
  double nees_sum_ = 0.0, pan_nees_sum_ = 0.0, square_sum_ = 0.0;
};

}  // namespace ols::ptu
