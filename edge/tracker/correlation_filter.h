// A discriminative model of the target: a filter whose response is high at the target and zero
// around it. It is spatially and temporally regularised: F. Li, C. Tian, W. Zuo, L. Zhang, M.-H.
// Yang, "Learning spatial-temporal regularized correlation filters for visual tracking", CVPR 2018.
#pragma once

#include "edge/tracker/feature_map.h"
#include "edge/tracker/spectrum.h"

namespace ols::tracker {

// The response of a filter in a window of a frame. Each cell has the response to a target whose
// centre is in this cell.
struct Response {
  struct Peak {
    // In the full frame, interpolated between cells.
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    double value = 0.0;
  };
  // The response at a pixel, and its mean and standard deviation away from that pixel.
  struct Contrast {
    double here = 0.0, mean = 0.0, sd = 0.0;
    double above() const { return here - mean; }
  };

  FeatureWindow window;
  Map values{};

  // The response at a pixel of the full frame; bilinear, 0 outside the window.
  double at(const Eigen::Vector2d& pixel) const;
  Peak peak() const;
  Contrast contrast(const Eigen::Vector2d& pixel) const;
  // The response at a pixel minus the mean of the response elsewhere, divided by the standard
  // deviation of the response elsewhere (peak-to-sidelobe ratio: D. S. Bolme et al., "Visual object
  // tracking using adaptive correlation filters", CVPR 2010).
  double prominence(const Eigen::Vector2d& pixel) const;
};

// The square window around `pixel`. Its side is four times the geometric mean of the target's width
// and height, `size_px`.
FeatureWindow window_around(const Eigen::Vector2d& pixel, const Eigen::Vector2d& size_px);

class CorrelationFilter {
 public:
  // Learns from this one window, with the target in a box of this size in its middle.
  CorrelationFilter(const WindowView& view, const Eigen::Vector2d& size_px);

  Response respond(const WindowView& view) const;
  // Learns that the target is in the middle of the window, and nowhere else in it. The filter
  // changes no more than necessary, and therefore hardly drifts. `share`: the weight of this image;
  // 1 for an image that certainly shows the target.
  void learn(const WindowView& view, double share);

 private:
  void fit(const Spectra& features, double inertia);

  Map support_{};    // 1 inside the box, where the filter may differ from zero
  Spectrum wanted_;  // the desired response: a narrow peak at zero shift
  Spectra filter_{};
};

}  // namespace ols::tracker
