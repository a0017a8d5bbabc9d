// A frame that is reduced to fit into a datagram.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace ols::video {

struct PreviewPicture {
  double scale = 1.0;  // size relative to the frame, at most 1
  std::vector<std::uint8_t> jpeg;
};

// Chooses the largest of some widths that fits; nullopt if none fits.
std::optional<PreviewPicture> preview_picture(const cv::Mat& gray);

}  // namespace ols::video
