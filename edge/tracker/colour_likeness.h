// The colours that the target has and its surroundings do not have: two histograms, as in L.
// Bertinetto, J. Valmadre, S. Golodetz, O. Miksik, P. H. S. Torr, "Staple: complementary learners
// for real-time tracking", CVPR 2016. They still fit when the target turns or changes its posture,
// so that the correlation filter no longer fits.
#pragma once

#include <vector>

#include "edge/tracker/correlation_filter.h"

namespace ols::tracker {

// kColour: blue, green and red. kHue: only the shares of blue and red in the brightness, which the
// exposure does not change. By hue, a grey target has no colours of its own.
enum class Palette { kColour, kHue };

class ColourLikeness {
 public:
  // Learns from this one window, with the target in a box of this size in its middle. Without a
  // colour image nothing is learnt, and the likeness stays unknown.
  ColourLikeness(Palette palette, const WindowView& view, const Eigen::Vector2d& size_px);

  // How much the colours of a box of this size resemble the target's, for each shift of the target
  // by a cell: 0 like the surroundings, 1 like the target. 0 everywhere if nothing is known.
  Response respond(const WindowView& view, const Eigen::Vector2d& size_px) const;
  // Learns that the target is in the middle of the window, and nowhere else in it. Afterwards, the
  // share `share` of what is known comes from this image.
  void learn(const WindowView& view, const Eigen::Vector2d& size_px, double share);

  // How well the colours separate the target from its surroundings, 0..1. It is measured in the
  // images that were learnt, each before it was learnt. Near 0 for a target without a colour of its
  // own.
  double separability() const;

 private:
  Map mean_probability(const WindowView& view, const Eigen::Vector2d& size_px) const;
  void learn_histograms(const WindowView& view, const Eigen::Vector2d& size_px, double share);
  void learn_level(const Response::Contrast& seen, double share);

  Palette palette_;
  // The share of each colour; the sum over all colours is 1.
  std::vector<float> target_, around_;
  std::vector<float> probability_;  // that a pixel of this colour is the target's
  // The mean probability of a box's pixels: its average and variance around the target, and by how
  // much it is higher at the target.
  double level_ = 0.0, variance_ = 0.0, above_ = 0.0;
};

}  // namespace ols::tracker
