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

inline constexpr int kCellSide = 4;    // [px] side of a cell in the resampled grey image
inline constexpr int kColourSide = 2;  // [px] side of a cell in the resampled colour image

// A window of a frame, resampled, with a border of one pixel. Outside the frame, the frame's
// outermost pixels are repeated.
struct WindowView {
  FeatureWindow window;
  cv::Mat gray;  // 8-bit; a cell is kCellSide pixels wide and high
  cv::Mat bgr;   // 8-bit blue, green, red, kColourSide pixels per cell side; empty without colour
};

WindowView view_window(const TrackerInput& frame, const FeatureWindow& window);

// The features of each cell: histograms of 12 signed and 6 unsigned orientations, relative to the
// gradients of the neighbouring cells (P. F. Felzenszwalb et al., "Object detection with
// discriminatively trained part-based models", PAMI 32(9), 2010); the sum of this normalised
// histogram; the grey level; red minus green; yellow minus blue. All values are small, and fall to
// zero towards the window's edge. Colours are zero if there is no colour image.
FeatureMap extract_features(const WindowView& view);

inline constexpr int kShapeChannels = 6;  // the unsigned orientations
// Writes only the unsigned orientations to `features`: kShapeChannels values for each of side x
// side cells, row by row. `sampled`: 8-bit, side * kCellSide pixels wide and high, plus a border of
// one pixel.
void add_shape(const cv::Mat& sampled, int side, float* features);

}  // namespace ols::tracker
