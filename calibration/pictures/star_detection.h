// Finds stars in a picture of the night sky, with their centres and their brightness above the
// background. Hot pixels, streaks (aircraft, satellites) and lit surfaces are rejected and counted.
// Pure.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace ols::calibration {

struct DetectedStar {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;  // 1-sigma of the less exact coordinate
  double flux = 0.0;   // [gray px] above the background
  bool saturated = false;
};

struct StarField {
  std::vector<DetectedStar> stars;  // brightest first
  int hot_pixels = 0, streaks = 0, surfaces = 0;
  double noise = 0.0;  // [gray] 1-sigma of a pixel
};

struct StarDetectionOptions {
  double threshold = 5.0;  // in units of the noise of the smoothed picture
  double widest_px = 4.0;  // largest 1-sigma width of a star's image; anything wider is a surface
  double longest = 2.0;    // largest ratio of length to width; with more, it is a streak
};

// `gray`: 8-bit or 16-bit.
StarField detect_stars(const cv::Mat& gray, const StarDetectionOptions& options = {});

}  // namespace ols::calibration
