// The conspicuous part of a designated box. Operators and labels draw generous boxes. With a bird
// of five pixels in a box of sixty, a template of the box is sky, and sky matches everywhere.
#pragma once

#include <opencv2/core.hpp>

namespace ols::tracker {

// The part of `box` that differs from the box's surroundings, with a margin. It is `box` itself in
// four cases: the part is most of the box, nothing is clearly conspicuous, the part crosses the
// border, or other parts are conspicuous too (the box then shows a target with parts). `gray` is
// 8-bit with one channel.
cv::Rect2d find_core(const cv::Mat& gray, const cv::Rect2d& box);

}  // namespace ols::tracker
