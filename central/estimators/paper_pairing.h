// The combination of pairs of views in the paper's estimator, and the first derivatives of its
// position with respect to the views' directions. Lengths in metres, ECEF components.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "central/estimators/paper_triangulation.h"
#include "geometry/precision_paper.h"

namespace ols::fusion {

// A pair of views whose rays intersect.
struct PaperBase {
  std::size_t first = 0, second = 0;  // indices of the views
  Eigen::Vector3d point;              // t_i
  Baseline baseline;
  double share = 0.0;  // weight in the position; all shares sum to 1
};

struct PaperPairing {
  Solution solution = Solution::kTooFewRays;
  Eigen::Vector3d position_ecef = nan_vector();
  std::vector<PaperBase> bases{};
  // Derivative of the position with respect to the centroid of the pairs' points. (The weights
  // depend on that centroid.)
  Eigen::Matrix3d by_centroid = Eigen::Matrix3d::Zero();
};

// All pairs of views, combined according to config.pairs. If no pair intersects, `solution` says
// why the last pair does not.
PaperPairing pair_views(const std::vector<PaperView>& views, const PaperConfig& config);

// The derivative of the position with respect to the direction of each view, for a change
// perpendicular to the direction. It is computed in closed form, because a difference quotient
// would evaluate all pairs four times for every view. The pair chosen by `best-baseline` is held
// fixed.
std::vector<Eigen::Matrix3d> derivatives_by_direction(const std::vector<PaperView>& views,
                                                      const PaperPairing& pairing,
                                                      const PaperConfig& config);

}  // namespace ols::fusion
