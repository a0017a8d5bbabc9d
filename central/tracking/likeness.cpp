#include "central/tracking/likeness.h"

#include <Eigen/Cholesky>

#include "geometry/chi_square.h"

namespace ols::fusion {
namespace {

// Probability that two estimates of one object count as two objects.
constexpr double kSamePlaceLevel = 0.01, kSameMotionLevel = 0.001;

}  // namespace

bool is_same_place(const KinematicState& a, const KinematicState& b) {
  static const double limit = chi_square_critical(kSamePlaceLevel, 3);
  const Eigen::Vector3d off = (a.mean - b.mean).head<3>();
  const Eigen::Matrix3d P = (a.covariance + b.covariance).topLeftCorner<3, 3>();
  return off.dot(P.ldlt().solve(off)) <= limit;
}

bool are_duplicates(const TrackFilter& track, const TrackFilter& other) {
  static const double limit = chi_square_critical(kSameMotionLevel, 6);
  const KinematicState own = track.at(track.utime_us());
  const KinematicState there = other.at(own.utime_us);
  const Eigen::Matrix<double, 6, 1> off = (own.mean - there.mean).head<6>();
  const Eigen::Matrix<double, 6, 6> P = (own.covariance + there.covariance).topLeftCorner<6, 6>();
  return off.dot(P.ldlt().solve(off)) < limit;
}

}  // namespace ols::fusion
