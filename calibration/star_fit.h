// The station's model fitted to stars that may be false: the second, exact half of
// calibration/star_identification.h.
#pragma once

#include <vector>

#include "calibration/star_votes.h"

namespace ols::calibration {

class StarFit {
 public:
  // Both must live as long as this.
  StarFit(const StationPrior& station, const std::vector<SeenFrame>& frames, double sd_px);

  struct Result {
    double heading_rad = 0.0;
    std::vector<StarPair> pairs;  // each detection and each star of a frame once
    // How many pairs there could be: of each frame as many as it has detections, but no more than
    // stars of the table stand in its image.
    std::size_t possible = 0;
    double rms_px = 0.0;                        // of a coordinate
    double focal_change = 0.0, focal_sd = 0.0;  // relative; by the stars alone
  };
  // From the pairs of a hypothesis to those that fit within some deviations.
  Result refined(const StarHypothesis& hypothesis) const;

 private:
  // The change of the parameters that suits the pairs and the priors best.
  struct Solution {
    ModelParameters change = ModelParameters::Zero();
    double rms_px = 0.0;
    double focal_variance = 0.0;
  };
  using Prior = Eigen::Matrix<double, kModelParameters, kModelParameters>;
  Solution solve(const std::vector<StarPair>& pairs, const ModelParameters& at, double sd_px,
                 const Prior& prior) const;
  std::vector<StarPair> matched(const StationModel& model, double gate_px) const;
  // The stars of a frame that stand in its image or near its edge, and where.
  std::vector<std::pair<std::size_t, Eigen::Vector2d>> in_image(const StationModel& model,
                                                                const SeenFrame& frame,
                                                                double edge_px) const;
  StationModel at(const ModelParameters& change) const;

  const StationPrior& station_;
  const std::vector<SeenFrame>& frames_;
  double sd_px_;  // of a detection
  Prior prior_;
};

}  // namespace ols::calibration
