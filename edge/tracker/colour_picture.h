// A colour picture as the camera delivers it. Only the parts that are needed are converted.
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

  // 8-bit blue, green, red; contains at least the part of `area` inside the picture.
  struct Part {
    cv::Mat bgr;
    cv::Point origin;  // its top-left pixel
  };
  Part part(const cv::Rect& area) const;
};

}  // namespace ols::tracker
