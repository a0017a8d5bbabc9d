// Reduces a frame so that it fits into a datagram, for the preview message.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace ols::video {

struct PreviewPicture {
  double scale = 1.0;  // width of the picture relative to that of the frame, at most 1
  std::vector<std::uint8_t> jpeg;
};

// Tries widths of 480, 320 and 160 px and returns the first picture that fits; nullopt if none
// fits.
std::optional<PreviewPicture> preview_picture(const cv::Mat& gray);

}  // namespace ols::video
