#include "edge/video/video_frame.h"

#include <algorithm>
#include <cmath>

namespace ols::video {
namespace {

struct Span {
  int first, count;
};

// The whole pixels that an interval touches, within 0 .. size.
Span pixels(double first, double length, int size) {
  const double last = std::clamp(std::ceil(first + length), 1.0, static_cast<double>(size));
  const double begin = std::clamp(std::floor(first), 0.0, last - 1.0);
  return {static_cast<int>(begin), static_cast<int>(last - begin)};
}

}  // namespace

cv::Rect region_of(const VideoRequest& request, const cv::Size& frame) {
  if (request.region.width <= 0.0 || request.region.height <= 0.0) return {{0, 0}, frame};
  const Span x = pixels(request.region.x, request.region.width, frame.width);
  const Span y = pixels(request.region.y, request.region.height, frame.height);
  return {x.first, y.first, x.count, y.count};
}

}  // namespace ols::video
