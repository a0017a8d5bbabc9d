// Optical flow of corners between two images, by the pyramidal Lucas-Kanade method.
#pragma once

#include <array>
#include <opencv2/core.hpp>

namespace ols::tracker {

// An image pyramid of four levels, as cv::pyrDown() makes it: a pixel's coordinates are halved from
// one level to the next. Each level has a margin that repeats its outermost pixels.
class ImagePyramid {
 public:
  static constexpr int kLevels = 4;
  static constexpr int kMargin = 16;  // [px] on each side

  // Copies an 8-bit image of one channel. The memory is reused.
  void build(const cv::Mat& image);
  const cv::Mat& level(int index) const { return levels_[static_cast<std::size_t>(index)]; }

 private:
  std::array<cv::Mat, kLevels> framed_;  // the levels with their margins
  std::array<cv::Mat, kLevels> levels_;  // views into framed_, without the margins
};

struct FollowedCorner {
  cv::Point2f at;
  double correlation = -1.0;  // of its surroundings in the two images; -1 if it was not found
};

// Finds in `current` the corner that is at `corner` in `previous`. The search starts at `guess`
// (J.-Y. Bouguet, "Pyramidal implementation of the Lucas Kanade feature tracker", Intel 2000).
// OpenCV's own version takes five times as long, because it differentiates the whole image and uses
// a larger window.
FollowedCorner follow_corner(const ImagePyramid& previous, const ImagePyramid& current,
                             const cv::Point2f& corner, const cv::Point2f& guess);

}  // namespace ols::tracker
