// Pictures of a hilly landscape for the tests of picture processing. Its relief and surfaces are
// lit from any side, and views are shifted by any fraction of a pixel.
#pragma once

#include <Eigen/Core>
#include <opencv2/imgproc.hpp>
#include <random>

#include "sim/world/texture.h"

namespace ols::calibration {

struct Light {
  double from_left = 1.0;   // -1: from the right
  double contrast = 1.0;    // less than 1: haze
  double brightness = 0.0;  // [gray]
};

class Scenery {
 public:
  explicit Scenery(unsigned seed, cv::Size size = {1024, 1024}) {
    std::mt19937_64 generator(seed);
    relief_ = sim::fractal_noise(size, 128, 3, 0.75, generator);
    surface_ = sim::fractal_noise(size, 128, 4, 0.6, generator);
  }

  // A point at p of the unshifted view is at p + shift of this view.
  cv::Mat view(const Eigen::Vector2d& shift, unsigned noise_seed, const Light& light = {},
               double noise_gray = 2.0, cv::Size size = {640, 480}) const {
    cv::Mat slope, lit, seen;
    cv::Sobel(relief_, slope, CV_32F, 1, 0, 3, 1.0 / 8.0);
    lit = 128.0 + light.brightness +
          light.contrast * (14.0 * surface_ + 50.0 * light.from_left * slope);
    cv::GaussianBlur(lit, lit, {}, 0.9);  // the lens
    const cv::Mat from =
        (cv::Mat_<double>(2, 3) << 1, 0, 150.0 - shift.x(), 0, 1, 150.0 - shift.y());
    cv::warpAffine(lit, seen, from, size, cv::INTER_CUBIC | cv::WARP_INVERSE_MAP);
    return with_noise(seen, noise_seed, noise_gray);
  }

  static cv::Mat with_noise(const cv::Mat& picture, unsigned seed, double sd_gray) {
    cv::Mat noise(picture.size(), CV_32F), gray;
    cv::RNG generator(seed);
    generator.fill(noise, cv::RNG::NORMAL, 0.0, sd_gray);
    noise += picture;
    noise.convertTo(gray, CV_8U);
    return gray;
  }

 private:
  cv::Mat relief_, surface_;
};

}  // namespace ols::calibration
