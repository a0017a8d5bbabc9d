#include "edge/video/preview_picture.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace ols::video {
namespace {

constexpr std::size_t kDatagram_bytes = 60000;  // leaves space for the header, below 65 000
constexpr int kQuality = 70;

}  // namespace

std::optional<PreviewPicture> preview_picture(const cv::Mat& gray) {
  for (const double width_px : {480.0, 320.0, 160.0}) {
    PreviewPicture picture{.scale = std::min(1.0, width_px / gray.cols), .jpeg = {}};
    cv::Mat small;
    cv::resize(gray, small, {}, picture.scale, picture.scale, cv::INTER_AREA);
    cv::imencode(".jpg", small, picture.jpeg, {cv::IMWRITE_JPEG_QUALITY, kQuality});
    if (picture.jpeg.size() < kDatagram_bytes) return picture;
  }
  return std::nullopt;
}

}  // namespace ols::video
