// The blend of a picture with its mirror image; the paper uses it to level a camera about its
// optical axis (section 4.2). If the camera is level, level lines continue without a break. If the
// camera is rolled, level lines cross their mirror images in the middle column. Pure.
#pragma once

#include <opencv2/core.hpp>

namespace ols::calibration {

// The mirror image exchanges left and right. Picture and mirror image have equal weight.
cv::Mat mirrored_blend(const cv::Mat& gray);

}  // namespace ols::calibration
