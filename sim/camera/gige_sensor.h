// Converts a gray image to the bytes of the simulated camera's pixel format. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

namespace ols::sim::gige {

// OpenCV's type of an image of this format (PFNC code).
int picture_type(std::uint32_t pixel_format);

// Converts `gray`, with a tint (red, green, blue), to this format. `raw` already has the right size
// and type.
void develop(const cv::Mat& gray, const std::array<double, 3>& tint, std::uint32_t pixel_format,
             cv::Mat& raw);

}  // namespace ols::sim::gige
