// Where corners of one image are in the next one: pyramidal Lucas and Kanade.
#pragma once

#include <array>
#include <opencv2/core.hpp>

namespace ols::tracker {

// An image and its halves, quarters and eighths, as cv::pyrDown() makes them: a pixel of one is at
// half its coordinates in the next. Around each the outermost pixels are continued.
class ImagePyramid {
 public:
  static constexpr int kLevels = 4;
  static constexpr int kMargin = 16;  // [px] on each side

  // Of an 8-bit image of one channel; copies it. The memory is used again.
  void build(const cv::Mat& image);
  const cv::Mat& level(int index) const { return levels_[static_cast<std::size_t>(index)]; }

 private:
  std::array<cv::Mat, kLevels> framed_;  // with their margins
  std::array<cv::Mat, kLevels> levels_;  // parts of these
};

struct FollowedCorner {
  cv::Point2f at;
  double correlation = -1.0;  // of its surroundings then and now; -1 when it was not found
};

// `guess` is where it is looked for first. J.-Y. Bouguet, "Pyramidal implementation of the Lucas
// Kanade feature tracker", Intel 2000. OpenCV's own takes the derivatives of the whole picture and
// a larger window, which costs five times as much.
FollowedCorner follow_corner(const ImagePyramid& previous, const ImagePyramid& current,
                             const cv::Point2f& corner, const cv::Point2f& guess);

}  // namespace ols::tracker
