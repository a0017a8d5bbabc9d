// Aligns an earlier image with the present one, so that the two can be subtracted.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "edge/tracker/ego_motion.h"

namespace ols::tracker {

// The pixels of the reduced frame that an area of the full frame touches; limited to the image.
cv::Rect reduced_area(const ReducedFrame& frame, const cv::Rect2d& area);

// The earlier image as the camera would see it now. Places outside the earlier image are copied
// from the present one. `now`: a part of the present image, with its top-left corner at `origin`.
// `to_present`: maps the earlier image's pixels to those of the whole present image.
cv::Mat brought_to_present(const cv::Mat& earlier, const Eigen::Matrix3d& to_present,
                           const cv::Mat& now, const cv::Point& origin);

}  // namespace ols::tracker
