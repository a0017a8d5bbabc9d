#include "central/filter/bias_observability.h"

#include <cmath>

namespace ols::fusion {

bool is_linear(const StationPart& part, const RayFrame& frame, double depth_m,
               const Eigen::Matrix3d& P_position, const FilterMatrix& P,
               const Eigen::Matrix2d& white) {
  constexpr double kSmall = 0.1;
  const double depth_variance = frame.direction.dot(P_position * frame.direction);
  const auto greatest = [&](const Eigen::Matrix<double, 2, 3>& H, Eigen::Index first) {
    return (H * whole_block<3>(P, first) * H.transpose()).diagonal().maxCoeff();
  };
  const Eigen::Index camera = part.first + kCameraState;
  double bias_variance = greatest(part.by_rotation, part.first) + P(camera, camera);
  if (part.has_place) {
    bias_variance +=
        greatest(frame.tangent.transpose() * part.R_ecef_enu / depth_m, part.first + kPoseStates);
  }
  const double second_order = bias_variance * depth_variance / (depth_m * depth_m);
  return second_order < kSmall * kSmall * white.trace() / 2.0;
}

// A bearing's equation is linearised about the predicted direction, whose error is also in the
// residual. Each update of a state is therefore wrong by the relative error of the depth, in the
// same sense for every bearing. Where a bearing contributes less information than that, the state's
// mean drifts by several sigmas while its variance stays (the same in SLAM with a moving camera:
// Huang, Mourikis and Roumeliotis, 2010). For the states of the station's own pose and position, in
// units of their sigmas: the drift, and the information that the bearing has along it. The depth is
// measured from the station's position, which moves the target along with it.
bool shows_bias(const FilterMatrix2& G, const FilterMatrix& P, const StationPart& part,
                const Eigen::Vector3d& along, double off_share) {
  constexpr double kSmall = 3.0;
  const Eigen::Index place = part.first + kPoseStates, clock = part.first + kClockState;
  double drift = 0.0;  // squared
  Eigen::RowVector2d told = Eigen::RowVector2d::Zero();
  const Eigen::Index end = part.has_place ? place + kPlaceStates : place;
  for (Eigen::Index at = part.first; at < end; ++at) {
    if (at == clock || !(P(at, at) > 0.0)) continue;
    double with_depth = P.block<1, 3>(at, 0).dot(along);
    if (part.has_place) {
      const Eigen::RowVector3d own = at < place ? P.block<3, 1>(place, at).transpose().eval()
                                                : whole_block<3>(P, place).row(at - place).eval();
      with_depth -= own.dot(part.R_ecef_enu.transpose() * along);
    }
    drift += with_depth * with_depth / P(at, at);
    told += with_depth / P(at, at) * G.row(at);
  }
  return drift * std::sqrt(drift) * off_share <= kSmall * told.squaredNorm();
}

}  // namespace ols::fusion
