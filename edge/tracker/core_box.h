// The part of a designated box that stands out. Operators and labels draw generous boxes: with a
// bird of five pixels in a box of sixty, a template of the box is sky, and sky matches everywhere.
#pragma once

#include <opencv2/core.hpp>

namespace ols::tracker {

// The part of `box` that differs from the box's surroundings, with a margin; `box` itself if this
// is most of it, if nothing stands out clearly, if what stands out crosses its border, or if other
// parts of the box stand out too: then the box shows a target with parts. `gray` is 8-bit with one
// channel.
cv::Rect2d find_core(const cv::Mat& gray, const cv::Rect2d& box);

}  // namespace ols::tracker
