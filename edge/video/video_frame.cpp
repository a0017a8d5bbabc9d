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

// H.264 codes whole pairs of pixels, and its decoders have a largest picture.
constexpr int kLeastSide_px = 16, kMostSide_px = 1920;

int even_side(double length) {
  const int even = 2 * static_cast<int>(std::floor(length / 2.0));
  return std::clamp(even, kLeastSide_px, kMostSide_px);
}

}  // namespace

cv::Rect region_of(const VideoRequest& request, const cv::Size& frame) {
  if (request.region.width <= 0.0 || request.region.height <= 0.0) return {{0, 0}, frame};
  const Span x = pixels(request.region.x, request.region.width, frame.width);
  const Span y = pixels(request.region.y, request.region.height, frame.height);
  return {x.first, y.first, x.count, y.count};
}

cv::Size picture_size(const VideoRequest& request, const cv::Size& region) {
  const double scale = std::min(1.0, static_cast<double>(request.max_width_px) / region.width);
  if (request.codec == VideoCodec::kH264) {
    const double longest = std::max(region.width, region.height) * scale;
    const double fitting = scale * std::min(1.0, kMostSide_px / longest);
    return {even_side(region.width * fitting), even_side(region.height * fitting)};
  }
  if (scale == 1.0) return region;
  return {request.max_width_px, std::max(1, static_cast<int>(std::lround(region.height * scale)))};
}

}  // namespace ols::video
