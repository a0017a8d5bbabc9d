#include "central/fusion/path_spread.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

// Predictions are kept more often than they are independent, and count less accordingly.
constexpr double kWeight = 0.25;
constexpr double kIndependent = 10.0;  // so many independent predictions count

}  // namespace

// A prediction that the present estimate cannot judge, because too few stations see the target, is
// dropped.
void PathSpread::compare(OneLead& one, const TrackFilter& filter, std::int64_t now_us) const {
  constexpr double kSharper = 0.1;  // of the variance
  const double keeps = std::exp(-kWeight / kIndependent);
  while (!one.predictions.empty() && one.predictions.front().utime_us <= now_us) {
    const KinematicState predicted = one.predictions.front();
    one.predictions.pop_front();
    const KinematicState there = filter.at(predicted.utime_us);
    const Eigen::Matrix3d P = predicted.covariance.topLeftCorner<3, 3>();
    if (there.covariance.topLeftCorner<3, 3>().trace() > kSharper * P.trace()) continue;
    const Eigen::Vector3d off = there.mean.head<3>() - predicted.mean.head<3>();
    const double nees = off.dot(P.llt().solve(off)) / 3.0;
    one.weight = kPrior + keeps * (one.weight - kPrior) + kWeight;
    one.sum = kPrior + keeps * (one.sum - kPrior) + kWeight * nees;
  }
}

void PathSpread::note(const TrackFilter& filter, std::int64_t now_us) {
  for (std::size_t i = 0; i < leads_.size(); ++i) {
    OneLead& one = leads_[i];
    compare(one, filter, now_us);
    if (now_us < one.next_us) continue;
    one.predictions.push_back(filter.at(now_us + std::llround(1e6 * kLeads_s[i])));
    one.next_us = now_us + std::llround(1e6 * kWeight * kLeads_s[i]);
  }
}

// Between the times ahead that are compared, the factor is interpolated; it is 1 for the present.
double PathSpread::factor(double lead_s) const {
  double from_s = 0.0, from = 1.0;
  for (std::size_t i = 0; i < leads_.size(); ++i) {
    const double to = leads_[i].factor();
    if (lead_s < kLeads_s[i])
      return from + (to - from) * (lead_s - from_s) / (kLeads_s[i] - from_s);
    from_s = kLeads_s[i];
    from = to;
  }
  return from;
}

}  // namespace ols::fusion
