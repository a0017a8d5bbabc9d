// Finds the edge between sky and land in a picture, near the rows where a model expects it. Pure.
//
// The picture is divided into strips of two columns. In each strip, every row near the expected
// one gets a likelihood: above the edge the brightness changes as it does in the sky of this
// picture, below it as it does in the land. Neighbouring strips have similar offsets from their
// expected rows, so all strips are solved together, as a hidden Markov model.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace ols::skyline {

inline constexpr int kStrip_px = 2;  // columns of a strip

// A row of the picture; row 0.0 is the middle of the topmost pixels.
struct Row {
  double at_px = 0.0;
  double sd_px = 0.0;  // 1-sigma
};
using Rows = std::vector<std::optional<Row>>;  // of each strip, from the left

inline int strips_of(int columns_px) { return columns_px / kStrip_px; }
// The middle of a strip [px].
inline double strip_x_px(int strip) { return kStrip_px * strip + 0.5 * (kStrip_px - 1); }

// `gray`: 8 bit, one channel. `expected`: a row, which may be outside the picture, for each strip;
// nullopt if nothing is known there. The result is nullopt where the edge is not clear: in cloud or
// haze, outside the picture, or where several rows are possible.
Rows find_skyline(const cv::Mat& gray, const Rows& expected);

}  // namespace ols::skyline
