#include "central/filter/coloured_noise.h"

#include "central/measurement/time_span.h"

namespace ols::fusion {

double ColouredNoise::observe(const BearingMeasurement& measurement, const RayFrame& frame,
                              BiasModel& evidence) {
  constexpr double kNearS = 0.3;  // over longer times the target's own motion shows
  const double first_s = seconds(utime_us_[1] - utime_us_[0]);
  const double second_s = seconds(measurement.utime_us - utime_us_[1]);
  if (second_s <= 0.0) return 1.0;
  if (utime_us_[0] > 0 && first_s + second_s < kNearS) {
    const double w = second_s / (first_s + second_s);
    const Eigen::Vector3d off = direction_[1] - w * direction_[0] - (1.0 - w) * frame.direction;
    const double white = (1.0 + w * w + (1.0 - w) * (1.0 - w)) *
                         evidence.noise_scale(measurement.station) *
                         measurement.sight.covariance_white.trace();
    evidence.observe_noise(measurement.station,
                           (frame.tangent.transpose() * off).squaredNorm() / white);
  }
  utime_us_ = {utime_us_[1], measurement.utime_us};
  direction_ = {direction_[1], frame.direction};
  if (first_s + second_s >= kNearS) return 1.0;
  const bool declared = !measurement.sight.covariance_systematic.isZero(0.0);
  return evidence.inflation(measurement.station, declared, second_s);
}

}  // namespace ols::fusion
