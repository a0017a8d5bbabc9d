#include "edge/detector/binned_residual.h"

#include <algorithm>
#include <cstddef>
#include <opencv2/imgproc.hpp>

namespace ols::detector {

void BinnedResidual::smooth_row(const cv::Mat& gray, int y) {
  const auto* above = gray.ptr<std::uint8_t>(std::max(0, 2 * y - 1));
  const auto* upper = gray.ptr<std::uint8_t>(2 * y);
  const auto* lower = gray.ptr<std::uint8_t>(2 * y + 1);
  const auto* below = gray.ptr<std::uint8_t>(std::min(gray.rows - 1, 2 * y + 2));
  auto* columns = columns_.data() + 1;
  for (int x = 0; x < gray.cols; ++x) {
    columns[x] = static_cast<std::int16_t>(above[x] + below[x] + 3 * (upper[x] + lower[x]));
  }
  columns[-1] = columns[0];
  columns[gray.cols] = columns[gray.cols - 1];
  auto* smooth = smooth_.ptr<std::int16_t>(y);
  for (int x = 0; x < smooth_.cols; ++x) {
    const auto* four = columns + 2 * x - 1;
    smooth[x] = static_cast<std::int16_t>(four[0] + four[3] + 3 * (four[1] + four[2]));
  }
}

cv::Mat BinnedResidual::measure(const cv::Mat& gray) {
  columns_.resize(static_cast<std::size_t>(gray.cols) + 2);
  smooth_.create(gray.rows / 2, gray.cols / 2, CV_16S);
  for (int y = 0; y < smooth_.rows; ++y) smooth_row(gray, y);
  cv::blur(smooth_, mean_, {9, 9}, {-1, -1}, cv::BORDER_REPLICATE);
  return smooth_ - mean_;
}

}  // namespace ols::detector
