// Optical flow of corners between two images: pyramidal Lucas-Kanade.
#pragma once

#include <array>
#include <opencv2/core.hpp>

namespace ols::tracker {

// An image pyramid of four levels, as made by cv::pyrDown(): a pixel has half its coordinates in
// the next level. Each level has a margin that repeats its outermost pixels.
class ImagePyramid {
 public:
  static constexpr int kLevels = 4;
  static constexpr int kMargin = 16;  // [px] on each side

  // Copies an 8-bit image of one channel. Memory is reused.
  void build(const cv::Mat& image);
  const cv::Mat& level(int index) const { return levels_[static_cast<std::size_t>(index)]; }

 private:
  std::array<cv::Mat, kLevels> framed_;  // with their margins
  std::array<cv::Mat, kLevels> levels_;  // parts of these
};

struct FollowedCorner {
  cv::Point2f at;
  double correlation = -1.0;  // of its surroundings in both images; -1: not found
};

// Searches from `guess` (J.-Y. Bouguet, "Pyramidal implementation of the Lucas Kanade feature
// tracker", Intel 2000). OpenCV's own version differentiates the whole image and uses a larger
// window, which costs five times as much.
FollowedCorner follow_corner(const ImagePyramid& previous, const ImagePyramid& current,
                             const cv::Point2f& corner, const cv::Point2f& guess);

}  // namespace ols::tracker
