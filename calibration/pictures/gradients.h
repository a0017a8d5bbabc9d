// Computes the gradients of a gray picture, and their noise. Pure.
#pragma once

#include <opencv2/core.hpp>

namespace ols::calibration {

// The 1-sigma [gray] of the noise from pixel to pixel, after J. Immerkaer, Fast Noise Variance
// Estimation, Computer Vision and Image Understanding 64 (1996), but with the median instead of the
// mean, because edges hardly change the median. In a fine texture, the result is too large.
double noise_of(const cv::Mat& gray);

struct Gradients {
  cv::Mat x, y;     // float [gray/px], of the smoothed picture
  double sd = 0.0;  // 1-sigma of x and of y, from noise and from rounding to whole gray levels
};
// `smoothing_px`: 1-sigma of the Gaussian applied first.
Gradients gradients_of(const cv::Mat& gray, double smoothing_px);

}  // namespace ols::calibration
