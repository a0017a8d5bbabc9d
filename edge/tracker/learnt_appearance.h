// The target's learnt appearance: the correlation filter and its usual response.
#pragma once

#include <optional>
#include <vector>

#include "edge/tracker/correlation_filter.h"

namespace ols::tracker {

class LearntAppearance {
 public:
  // Starts with the target in this box of `frame`.
  LearntAppearance(const TrackerInput& frame, const Eigen::Vector2d& pixel,
                   const Eigen::Vector2d& size_px);

  // Searches for the target in windows around these places of a new frame. Returns the position of
  // the strongest response, if it is at least `least` of the usual response.
  std::optional<Eigen::Vector2d> find(const TrackerInput& frame,
                                      const std::vector<Eigen::Vector2d>& places,
                                      const Eigen::Vector2d& size_px, double least);
  // Also searches around this place, unless it is well inside a searched window. (A window fades
  // towards its edge.)
  void look_at(const TrackerInput& frame, const Eigen::Vector2d& pixel,
               const Eigen::Vector2d& size_px);
  // The response at a pixel of the newest frame, relative to the usual one; 0 where no search took
  // place.
  double recognised(const Eigen::Vector2d& pixel) const;
  // That response, relative to the deviation of the response elsewhere; 0 where no search took
  // place.
  double prominence(const Eigen::Vector2d& pixel) const;
  // Learns that the target is at `pixel` of the newest frame.
  void learn(const TrackerInput& frame, const Eigen::Vector2d& pixel,
             const Eigen::Vector2d& size_px, double interval_s);

 private:
  CorrelationFilter filter_;
  std::vector<Response> responses_;  // those in the newest frame
  double usual_;                     // usual response at the target
};

}  // namespace ols::tracker
