// Learns which colours distinguish the target from its surroundings, by two colour histograms: L.
// Bertinetto, J. Valmadre, S. Golodetz, O. Miksik, P. H. S. Torr, "Staple: complementary learners
// for real-time tracking", CVPR 2016. If the target turns or changes its posture, its colours still
// fit, but the correlation filter does not.
#pragma once

#include <vector>

#include "edge/tracker/correlation_filter.h"

namespace ols::tracker {

// kColour: blue, green and red. kHue: only the shares of blue and of red in the sum of the three.
// Exposure does not change these shares. A grey target does not differ in hue from grey
// surroundings.
enum class Palette { kColour, kHue };

class ColourLikeness {
 public:
  // Learns from this one window, with the target in a box of this size in its middle. Without a
  // colour image nothing is learnt, and the likeness stays unknown.
  ColourLikeness(Palette palette, const WindowView& view, const Eigen::Vector2d& size_px);

  // For each cell of the window: how much a box of this size around it resembles the target in its
  // colours. 0 means like the surroundings, 1 like the target. 0 everywhere if no colours are
  // known.
  Response respond(const WindowView& view, const Eigen::Vector2d& size_px) const;
  // Learns that the target is in the middle of the window, and nowhere else in it. `share`: the
  // weight of this image in the new averages, 0..1.
  void learn(const WindowView& view, const Eigen::Vector2d& size_px, double share);

  // How well the colours separate the target from its surroundings, 0..1. Each image contributes to
  // this value before its colours are learnt. Near 0 for a target without a colour of its own.
  double separability() const;

 private:
  Map mean_probability(const WindowView& view, const Eigen::Vector2d& size_px) const;
  void learn_histograms(const WindowView& view, const Eigen::Vector2d& size_px, double share);
  void learn_level(const Response::Contrast& seen, double share);

  Palette palette_;
  // Histograms of the target and of its surroundings; each sums to 1.
  std::vector<float> target_, around_;
  std::vector<float> probability_;  // for each colour: that its pixels belong to the target
  double level_ = 0.0;     // mean probability in a box, averaged over boxes away from the target
  double variance_ = 0.0;  // variance of the mean probability from box to box
  double above_ = 0.0;     // mean probability in the target's box, minus level_
};

}  // namespace ols::tracker
