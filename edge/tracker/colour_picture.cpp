#include "edge/tracker/colour_picture.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace ols::tracker {
namespace {

bool is_mosaic(ColourLayout layout) {
  return layout != ColourLayout::kBgr && layout != ColourLayout::kRgb;
}

int to_bgr(ColourLayout layout) {
  switch (layout) {
    case ColourLayout::kBayerRg:
      return cv::COLOR_BayerRGGB2BGR;
    case ColourLayout::kBayerGr:
      return cv::COLOR_BayerGRBG2BGR;
    case ColourLayout::kBayerGb:
      return cv::COLOR_BayerGBRG2BGR;
    case ColourLayout::kBayerBg:
      return cv::COLOR_BayerBGGR2BGR;
    default:
      return cv::COLOR_RGB2BGR;
  }
}

struct Span {
  int first, end;
};

// A mosaic's parts begin at an even pixel, or they would be of another pattern, and hold the
// neighbours that the conversion needs.
Span whole_cells(int first, int end, int size) {
  constexpr int kLeast = 4, kNeighbours = 2;  // [px]
  const int begin = std::clamp(first - kNeighbours, 0, std::max(0, size - kLeast)) & ~1;
  return {begin, std::clamp(end + kNeighbours, std::min(size, begin + kLeast), size)};
}

}  // namespace

bool ColourPicture::valid(const cv::Size& size) const {
  const int type = is_mosaic(layout) ? CV_8UC1 : CV_8UC3;
  return image.type() == type && image.size() == size;
}

ColourPicture::Part ColourPicture::part(const cv::Rect& area) const {
  if (layout == ColourLayout::kBgr) return {image, {0, 0}};
  const Span x = whole_cells(area.x, area.br().x, image.cols);
  const Span y = whole_cells(area.y, area.br().y, image.rows);
  Part part{cv::Mat(), {x.first, y.first}};
  cv::cvtColor(image(cv::Range(y.first, y.end), cv::Range(x.first, x.end)), part.bgr,
               to_bgr(layout));
  return part;
}

}  // namespace ols::tracker
