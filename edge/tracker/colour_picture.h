// A colour picture as the camera delivers it. Only the requested part is converted.
#pragma once

#include <opencv2/core.hpp>

namespace ols::tracker {

// The layout of a mosaic is named by the pixels of its first row, as in GenICam's formats.
enum class ColourLayout { kBgr, kRgb, kBayerRg, kBayerGr, kBayerGb, kBayerBg };

struct ColourPicture {
  cv::Mat image = {};  // 8-bit; three channels, or one for a mosaic
  ColourLayout layout = ColourLayout::kBgr;

  bool empty() const { return image.empty(); }
  bool valid(const cv::Size& size) const;

  // A converted part of the picture: 8-bit blue, green, red. part() returns at least the pixels of
  // `area` that are inside the picture.
  struct Part {
    cv::Mat bgr;
    cv::Point origin;  // its top-left pixel
  };
  Part part(const cv::Rect& area) const;
};

}  // namespace ols::tracker
