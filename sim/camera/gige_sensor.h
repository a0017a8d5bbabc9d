// Converts a gray image to the bytes of the simulated camera's pixel format. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

namespace ols::sim::gige {

// The OpenCV type (CV_8UC1, ...) of an image in this format (PFNC code).
int picture_type(std::uint32_t pixel_format);

// Converts `gray` to this format. `tint`: the factors of red, green and blue. `raw` must already
// have the right size and type.
void develop(const cv::Mat& gray, const std::array<double, 3>& tint, std::uint32_t pixel_format,
             cv::Mat& raw);

}  // namespace ols::sim::gige
