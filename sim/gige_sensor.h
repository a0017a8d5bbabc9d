// What the simulated camera makes of a gray picture: the bytes of its pixel format. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

namespace ols::sim::gige {

// OpenCV's type of a picture of this format (PFNC code).
int picture_type(std::uint32_t pixel_format);

// `gray` seen through a tint (of red, green, blue) in this format. `raw` has the right size and
// type already.
void develop(const cv::Mat& gray, const std::array<double, 3>& tint, std::uint32_t pixel_format,
             cv::Mat& raw);

}  // namespace ols::sim::gige
