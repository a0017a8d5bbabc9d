// The target's learnt appearance: the correlation filter with its usual response, and the colours.
#pragma once

#include <optional>
#include <vector>

#include "edge/tracker/colour_likeness.h"
#include "edge/tracker/correlation_filter.h"

namespace ols::tracker {

class LearntAppearance {
 public:
  // Starts with the target in this box of `frame`.
  LearntAppearance(const TrackerInput& frame, const Eigen::Vector2d& pixel,
                   const Eigen::Vector2d& size_px);

  // Searches for the target in windows around these places of a new frame. Returns the position of
  // the strongest response, if this response is at least `least` times the usual one.
  std::optional<Eigen::Vector2d> find(const TrackerInput& frame,
                                      const std::vector<Eigen::Vector2d>& places,
                                      const Eigen::Vector2d& size_px, double least);
  // Also searches around this place, unless it is near the centre of a window that has been
  // searched. (Responses fade towards a window's edge.)
  void look_at(const TrackerInput& frame, const Eigen::Vector2d& pixel,
               const Eigen::Vector2d& size_px);
  // The response of filter and colours at a pixel of the newest frame, relative to the usual one; 0
  // where no search took place.
  double recognised(const Eigen::Vector2d& pixel) const;
  // Response::prominence() of the filter at a pixel of the newest frame; 0 where no search took
  // place.
  double prominence(const Eigen::Vector2d& pixel) const;
  // How much the colours at a pixel of the newest frame resemble the target's first colours: 0 like
  // the rest of the window, 1 like the target at the start. 0 where no search took place.
  double first_colours(const Eigen::Vector2d& pixel) const;
  // ColourLikeness::separability() of the target's first colours; 0 where no search in a colour
  // image took place.
  double first_separability(const Eigen::Vector2d& pixel) const;
  // Learns that the target is at `pixel` of the newest frame. If the colours there are unlike the
  // target's, less is learnt.
  void learn(const TrackerInput& frame, const Eigen::Vector2d& pixel,
             const Eigen::Vector2d& size_px, double interval_s);

 private:
  struct Searched {
    Response filter;   // relative to the usual one
    Response colours;  // ColourLikeness::respond()
    Response both;     // their weighted mean
    Response first;    // response of first_colours_
    bool in_colour = false;
  };

  LearntAppearance(const WindowView& view, const Eigen::Vector2d& size_px);
  Searched search(const TrackerInput& frame, const Eigen::Vector2d& pixel,
                  const Eigen::Vector2d& size_px) const;
  double colour(const Eigen::Vector2d& pixel) const;
  const Searched* best_at(const Eigen::Vector2d& pixel) const;

  CorrelationFilter filter_;
  ColourLikeness colours_;
  ColourLikeness first_colours_;
  double first_s_ = 0.0;            // time over which first_colours_ have been learnt
  std::vector<Searched> searched_;  // in the newest frame
  double usual_;                    // the filter's usual response at the target
};

}  // namespace ols::tracker
