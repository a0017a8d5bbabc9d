// How well the predictions of one target's path have come true. Pure.
//
// The motion models of the filter allow for hard manoeuvres at any instant. Most targets fly more
// smoothly, so that the covariance predicted for some seconds ahead is far too large. This class
// keeps past predictions and compares them with the filter's estimates once their time has come.
// The factor on the covariance is the mean of their normalised squared errors. About ten
// independent predictions over the same time ahead count, each with three components; the filter's
// own covariance counts as one more component. A target that has flown smoothly ten times as long
// may still manoeuvre now.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <deque>

#include "central/filter/interacting_models.h"
#include "central/filter/track_filter.h"

namespace ols::fusion {

class PathSpread {
 public:
  // Compares the predictions for times up to now_us with the filter, and keeps new ones. Call often
  // while the target is being tracked.
  void note(const TrackFilter& filter, std::int64_t now_us);
  // The factor on the covariance of a position predicted for lead_s >= 0 ahead.
  double factor(double lead_s) const;

 private:
  static constexpr double kPrior = 1.0 / 3.0;  // weight of one component
  static constexpr std::array<double, 4> kLeads_s = {1.0, 2.0, 4.0, 8.0};

  struct OneLead {
    std::int64_t next_us = 0;  // when the next prediction is kept
    std::deque<KinematicState> predictions;
    // Of the normalised squared errors, the prior included.
    double weight = kPrior, sum = kPrior;

    double factor() const { return sum / weight; }
  };
  void compare(OneLead& one, const TrackFilter& filter, std::int64_t now_us) const;

  std::array<OneLead, kLeads_s.size()> leads_;
};

}  // namespace ols::fusion
