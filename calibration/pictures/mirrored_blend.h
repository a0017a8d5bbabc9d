// The paper's picture for rotating a camera about its optical axis (section 4.2): the blend of a
// picture and its mirror image. Level lines continue without a break. If the camera is rolled, they
// cross their mirror images in the middle column. Pure.
#pragma once

#include <opencv2/core.hpp>

namespace ols::calibration {

// The mirror image exchanges left and right. Picture and mirror image have equal weight.
cv::Mat mirrored_blend(const cv::Mat& gray);

}  // namespace ols::calibration
