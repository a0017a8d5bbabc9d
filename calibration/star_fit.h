// Fits the station's model to detected stars; some detections may be false. This is the second,
// exact step of calibration/star_identification.h.
#pragma once

#include <vector>

#include "calibration/star_votes.h"

namespace ols::calibration {

class StarFit {
 public:
  // Both arguments must outlive this object.
  StarFit(const StationPrior& station, const std::vector<SeenFrame>& frames, double sd_px);

  struct Result {
    double heading_rad = 0.0;
    std::vector<StarPair> pairs;  // each detection and each star occurs at most once in a frame
    // The largest possible number of pairs. Each frame contributes the number of its detections or
    // the number of the table's stars in its image, whichever is smaller.
    std::size_t possible = 0;
    double rms_px = 0.0;                        // RMS residual of each coordinate
    double focal_change = 0.0, focal_sd = 0.0;  // relative change; the stars alone determine it
  };
  // Starts from the pairs of a hypothesis. Finds all pairs of a detection and a star that fit to
  // within a few sigmas.
  Result refined(const StarHypothesis& hypothesis) const;

 private:
  // The change of the parameters that fits the pairs and the priors best.
  struct Solution {
    ModelParameters change = ModelParameters::Zero();
    double rms_px = 0.0;
    double focal_variance = 0.0;
  };
  using Prior = Eigen::Matrix<double, kModelParameters, kModelParameters>;
  Solution solve(const std::vector<StarPair>& pairs, const ModelParameters& at, double sd_px,
                 const Prior& prior) const;
  std::vector<StarPair> matched(const StationModel& model, double gate_px) const;
  // The stars in or near a frame's image, each with its index and its pixel.
  std::vector<std::pair<std::size_t, Eigen::Vector2d>> in_image(const StationModel& model,
                                                                const SeenFrame& frame,
                                                                double edge_px) const;
  StationModel at(const ModelParameters& change) const;

  const StationPrior& station_;
  const std::vector<SeenFrame>& frames_;
  double sd_px_;  // 1-sigma of a detection
  Prior prior_;
};

}  // namespace ols::calibration
