#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <optional>
#include <vector>

#include "central/filter/track_filter.h"
#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using Eigen::Vector3d;
using test::feed;
using test::flight;
using test::kStart;
using test::path;
using test::ray_to;
using test::site;
using test::square;
using test::turned;

// With all correlations of the stations' states: rotation, clock and position. With one model the
// whole state is available, and the prediction of a bearing follows from it directly.
class OneModel : public testing::TestWithParam<Motion> {
 protected:
  struct Expected {
    Eigen::Vector2d residual;
    Eigen::MatrixXd H;
    Eigen::Matrix2d S;
  };

  // After four seconds of flight, when a bearing has information on biases.
  OneModel() {
    config.motion.models = {GetParam()};
    filter.emplace(
        config, kStart,
        FilterStart{
            .p_ecef = site().to_ecef(path(0.0)), .position_sd_m = 100.0, .velocity_sd_m_s = 50.0});
    seen = flight(4.0, 1e-4, 1e-4);
    for (BearingMeasurement& measurement : seen) {
      measurement.sight.covariance_systematic = 1e-7 * Eigen::Matrix2d::Identity();
      measurement.sight.origin_sd_enu_m.setConstant(0.2);
      measurement.clock_sd_s = 1e-2;
      EXPECT_EQ(feed(*filter, measurement, errors), BearingUse::kUsed);
    }
  }

  // Of the last station, at this offset from the state's own instant, with an error.
  BearingMeasurement next(double ahead_s) const {
    BearingMeasurement result = seen.back();
    EXPECT_EQ(filter->stations().back().station, result.station);
    result.utime_us = filter->utime_us() + std::llround(1e6 * ahead_s);
    const double t_s = static_cast<double>(result.utime_us - kStart) * 1e-6;
    const Ray ray = turned(ray_to("d", square()[3], path(t_s)), 1e-4, -1e-4);
    result.sight.direction = ray.sight.direction;
    return result;
  }

  Expected expected(const BearingMeasurement& next, double ahead_s) const {
    const auto [mean, P] = filter->mixed();
    const bool curves = GetParam() != Motion::kConstantVelocity;
    const double curved_s2 = curves ? ahead_s * ahead_s / 2.0 : 0.0;
    const RayFrame frame = ray_frame(next.sight);
    const Vector3d line = mean.head<3>() + ahead_s * mean.segment<3>(3) +
                          curved_s2 * mean.segment<3>(6) - next.sight.origin_ecef;
    const double depth = frame.direction.dot(line);
    const Eigen::Vector2d predicted = frame.tangent.transpose() * line / depth;
    const Eigen::Matrix<double, 2, 3> J =
        (frame.tangent.transpose() - predicted * frame.direction.transpose()) / depth;
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2, mean.size());
    const Eigen::Index last = mean.size() - kStationStates;
    H.leftCols<3>() = J;
    H.middleCols<3>(3) = ahead_s * J;
    H.middleCols<3>(6) = curved_s2 * J;
    H.middleCols<3>(last) = shift_by_rotation(tangent_basis(next.sight.direction));
    H(1, last + kCameraState) = 1.0;
    H.col(last + kClockState) = -J * mean.segment<3>(3);
    H.rightCols<3>() = -J * R_ecef_enu(next.sight.origin_ecef);
    const Transition between =
        transition(GetParam(), mean.head<9>(), std::abs(ahead_s), config.motion);
    const Eigen::Matrix2d S = H * P * H.transpose() + between.q(0, 0) * J * J.transpose() +
                              next.sight.covariance_white * errors.noise_scale(next.station);
    return {-predicted - H.rightCols(kStationStates) * mean.tail(kStationStates), H, S};
  }

  FilterConfig config;
  BiasModel errors;
  std::optional<TrackFilter> filter;
  std::vector<BearingMeasurement> seen;
};

TEST_P(OneModel, GatesByTheWholeStatesCovariance) {
  ASSERT_EQ(filter->mixed().mean.size(), 9 + 4 * kStationStates);
  for (const double ahead_s : {0.0, -0.1}) {
    const auto [r, H, S] = expected(next(ahead_s), ahead_s);
    const double nis = r.dot(S.inverse() * r);
    EXPECT_NEAR(filter->innovation(next(ahead_s), errors).nis, nis, 1e-6 * nis) << ahead_s;
  }
}

// A late bearing corrects the current state, including the velocity.
TEST_P(OneModel, LearnsByTheWholeStatesGain) {
  for (const double ahead_s : {0.0, -0.1}) {
    TrackFilter after = *filter;
    BiasModel others = errors;
    const auto [mean, P] = filter->mixed();
    const auto [r, H, S] = expected(next(ahead_s), ahead_s);
    ASSERT_LT(r.dot(S.inverse() * r), config.robust_nis);
    ASSERT_EQ(feed(after, next(ahead_s), others), BearingUse::kUsed);
    const Eigen::MatrixXd K = P * H.transpose() * S.inverse();
    const Eigen::VectorXd sd = P.diagonal().cwiseSqrt();
    const auto learnt = after.mixed();
    EXPECT_LT(((learnt.mean - mean - K * r).array() / sd.array()).abs().maxCoeff(), 1e-6);
    const Eigen::MatrixXd left = P - K * S * K.transpose() - learnt.covariance;
    EXPECT_LT((left.array() / (sd * sd.transpose()).array()).abs().maxCoeff(), 1e-6) << ahead_s;
    EXPECT_GT(((K * r).array() / sd.array()).abs().maxCoeff(), 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(Motions, OneModel,
                         testing::Values(Motion::kConstantVelocity, Motion::kCoordinatedTurn,
                                         Motion::kAcceleration));

}  // namespace
}  // namespace ols::fusion
