// What stands out inside a designated box. Operators and labels draw boxes generously: of a bird of
// five pixels in a box of sixty, a template of the box is sky, and sky fits everywhere.
#pragma once

#include <opencv2/core.hpp>

namespace ols::tracker {

// The part of `box` that holds what differs from the box's surroundings, with a margin; `box`
// itself where that is most of it, where nothing stands out clearly or where what does reaches over
// its border. `gray` is 8-bit with one channel.
cv::Rect2d find_core(const cv::Mat& gray, const cv::Rect2d& box);

}  // namespace ols::tracker
