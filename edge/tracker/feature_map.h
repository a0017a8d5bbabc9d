// The features of the correlation filter, for each cell: histograms of oriented gradients, grey
// level and colours.
#pragma once

#include "edge/tracker/particle.h"
#include "edge/tracker/spectrum.h"
#include "edge/tracker/target_tracker.h"

namespace ols::tracker {

using FeatureMap = std::array<Map, kChannels>;

// A square part of a frame, divided into kMapSide x kMapSide cells.
struct FeatureWindow {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // centre
  double cell_px = 1.0;                             // side of a cell
};

inline constexpr int kCellSide = 4;    // [px] of the resampled grey image
inline constexpr int kColourSide = 2;  // the same in colour

// A window of a frame, resampled, with a border of one pixel. Outside the image, its border is
// continued.
struct WindowView {
  FeatureWindow window;
  cv::Mat gray;  // 8-bit, kCellSide pixels a cell
  cv::Mat bgr;   // 8-bit blue, green, red, kColourSide pixels a cell; empty without a colour image
};

WindowView view_window(const TrackerInput& frame, const FeatureWindow& window);

// The features of each cell: histograms of 12 signed and 6 unsigned orientations, relative to the
// gradients of the neighbouring cells (P. F. Felzenszwalb et al., "Object detection with
// discriminatively trained part-based models", PAMI 32(9), 2010); these gradients; the grey level;
// red against green; yellow against blue. All values are small, and tapered towards the window's
// edge. Colours are zero if there is no colour image.
FeatureMap extract_features(const WindowView& view);

inline constexpr int kShapeChannels = 6;  // the unsigned orientations
// Adds only the unsigned orientations, cell by cell: kShapeChannels for each of side x side cells.
// The 8-bit image must have a border of one additional pixel.
void add_shape(const cv::Mat& sampled, int side, float* features);

}  // namespace ols::tracker
