// Finds the conspicuous part of a designated box. Operators draw generous boxes. If the box is
// sixty pixels wide and the bird in it is five pixels wide, a template of the box is mostly sky,
// and sky matches everywhere.
#pragma once

#include <opencv2/core.hpp>

namespace ols::tracker {

// Returns the part of `box` that differs from the box's surroundings, with a margin. Returns `box`
// itself in four cases: the part fills most of the box; nothing is clearly conspicuous; the part
// touches the border of the box; or other parts are conspicuous too (the target then has several
// parts). `gray`: 8-bit, one channel.
cv::Rect2d find_core(const cv::Mat& gray, const cv::Rect2d& box);

}  // namespace ols::tracker
