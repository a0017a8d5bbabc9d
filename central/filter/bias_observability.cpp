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
  double bias_variance = greatest(part.by_rotation, part.first);
  if (part.has_place) {
    bias_variance +=
        greatest(frame.tangent.transpose() * part.R_ecef_enu / depth_m, part.first + kPoseStates);
  }
  const double second_order = bias_variance * depth_variance / (depth_m * depth_m);
  return second_order < kSmall * kSmall * white.trace() / 2.0;
}

// A bearing's equation is linear about the predicted direction, whose error is also in the
// residual. So what a state gains from it is off to one side, in every bearing anew, by what goes
// with the depth, over the depth. Where a bearing tells less than that of a state, its mean drifts
// away by sigmas while its variance stays (the same in mapping by a moving camera: Huang, Mourikis
// and Roumeliotis, 2010). Of the states of the station's own pose and place, over their sigmas: the
// drift, and what the bearing tells along that. The depth is that from the place, which moves the
// target along with it.
bool shows_bias(const FilterMatrix2& G, const FilterMatrix& P, const StationPart& part,
                const Eigen::Vector3d& along, double off_share) {
  constexpr double kSmall = 3.0;
  const Eigen::Index place = part.first + kPoseStates, clock = part.first + 3;
  double drift = 0.0;  // squared
  Eigen::RowVector2d told = Eigen::RowVector2d::Zero();
  for (Eigen::Index at = part.first; at < (part.has_place ? place + kPlaceStates : clock); ++at) {
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
