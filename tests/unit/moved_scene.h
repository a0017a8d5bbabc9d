// A picture with edges everywhere, shifted by a given amount. Tests compare two such pictures as
// two views of the same place.
#pragma once

#include <opencv2/imgproc.hpp>

namespace ols {

// Different seeds give pictures of different places.
inline cv::Mat moved_scene(int seed, double right_px, double down_px = 0.0) {
  cv::Mat small(60, 80, CV_8U), big, moved;
  cv::RNG random(static_cast<std::uint64_t>(seed) + 5);
  random.fill(small, cv::RNG::UNIFORM, 30, 220);
  cv::resize(small, big, {640, 480}, 0, 0, cv::INTER_CUBIC);
  const cv::Mat by = (cv::Mat_<double>(2, 3) << 1, 0, right_px, 0, 1, down_px);
  cv::warpAffine(big, moved, by, big.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  return moved;
}

}  // namespace ols
