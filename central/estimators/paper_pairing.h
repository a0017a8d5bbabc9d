// The combination of pairs of views in the paper's estimator, and the first derivatives of the
// estimated position with respect to the views' directions. Lengths in metres, ECEF components.
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
  Eigen::Vector3d point;              // the position that this pair gives
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

// Combines all pairs of views as config.pairs demands. If no pair intersects, `solution` is the
// reason why the last pair does not.
PaperPairing pair_views(const std::vector<PaperView>& views, const PaperConfig& config);

// The derivatives of the position with respect to the direction of each view, for changes
// perpendicular to the direction. They are computed in closed form: difference quotients would
// evaluate all pairs four times for every view. With kBestBaseline, the choice of the pair counts
// as fixed.
std::vector<Eigen::Matrix3d> derivatives_by_direction(const std::vector<PaperView>& views,
                                                      const PaperPairing& pairing,
                                                      const PaperConfig& config);

}  // namespace ols::fusion
