// Finds the edge between sky and land in a picture, near the rows at which a model expects it.
// Pure.
//
// The picture is divided into strips of two columns. In each strip, every row near the expected one
// gets a likelihood of being the edge: the brightness above it must vary as in this picture's sky,
// and the brightness below it as in this picture's land. Neighbouring strips have similar offsets
// from their expected rows. Therefore, all strips are solved together, as a hidden Markov model.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "edge/skyline/strip_steps.h"

namespace ols::skyline {

// A row of the picture; row 0.0 is the middle of the topmost pixels.
struct Row {
  double at_px = 0.0;
  double sd_px = 0.0;  // 1-sigma
};
using Rows = std::vector<std::optional<Row>>;  // one for each strip, from left to right

// `gray`: 8 bit, one channel. `expected`: for each strip the expected row, which may be outside the
// picture; nullopt if it is unknown. The result is nullopt for strips without a clear edge: in
// cloud or haze, outside the picture, or if several rows are possible.
Rows find_skyline(const cv::Mat& gray, const Rows& expected);

// The probability of each row of each strip to be the edge, if nothing is known about it. The
// result has one row for each strip. Its first and last columns are for an edge above and below the
// picture. The uppermost sixth of the picture counts as sky, the lowest as land.
cv::Mat edge_probabilities(const cv::Mat& gray);

}  // namespace ols::skyline
