// The target's learnt appearance: the correlation filter, and its usual response.
#pragma once

#include <optional>
#include <vector>

#include "edge/tracker/correlation_filter.h"

namespace ols::tracker {

class LearntAppearance {
 public:
  // Begins with the target in this box of `frame`.
  LearntAppearance(const TrackerInput& frame, const Eigen::Vector2d& pixel,
                   const Eigen::Vector2d& size_px);

  // Searches for the target in windows around these places of a new frame. Returns the strongest
  // response, if it is at least `least` of the usual response.
  std::optional<Eigen::Vector2d> find(const TrackerInput& frame,
                                      const std::vector<Eigen::Vector2d>& places,
                                      const Eigen::Vector2d& size_px, double least);
  // Also searches around this place, unless it is well inside a searched window: a window fades
  // towards its edge.
  void look_at(const TrackerInput& frame, const Eigen::Vector2d& pixel,
               const Eigen::Vector2d& size_px);
  // The response there in the newest frame, relative to the usual one; 0 where nothing was
  // searched.
  double recognised(const Eigen::Vector2d& pixel) const;
  // The same response over the deviation of the response elsewhere; 0 where nothing was searched.
  double prominence(const Eigen::Vector2d& pixel) const;
  // Learns that the target is there in the newest frame.
  void learn(const TrackerInput& frame, const Eigen::Vector2d& pixel,
             const Eigen::Vector2d& size_px, double interval_s);

 private:
  CorrelationFilter filter_;
  std::vector<Response> responses_;  // of the newest frame
  double usual_;                     // response at the target
};

}  // namespace ols::tracker
