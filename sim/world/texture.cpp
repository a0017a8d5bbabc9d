#include "sim/world/texture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sim/scenario/normal.h"

namespace ols::sim {
namespace {

// White noise on a coarse periodic grid, enlarged smoothly to `size`.
cv::Mat octave(cv::Size size, double wavelength_px, std::mt19937_64& generator) {
  constexpr int kMargin = 3;  // nodes repeated beyond the edges, for the cubic kernel
  const int columns = std::max(2, static_cast<int>(std::lround(size.width / wavelength_px)));
  const int rows = std::max(2, static_cast<int>(std::lround(size.height / wavelength_px)));
  cv::Mat grid(rows, columns, CV_32F), wrapped, large;
  Normal<float> normal;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) grid.at<float>(y, x) = normal(generator);
  }
  cv::copyMakeBorder(grid, wrapped, kMargin, kMargin, kMargin, kMargin, cv::BORDER_WRAP);
  const double sx = static_cast<double>(size.width) / columns;
  const double sy = static_cast<double>(size.height) / rows;
  const cv::Matx23d to_grid(1 / sx, 0, kMargin, 0, 1 / sy, kMargin);
  cv::warpAffine(wrapped, large, to_grid, size, cv::INTER_CUBIC | cv::WARP_INVERSE_MAP);
  return large;
}

// Draws a disc on a periodic image.
void disc(cv::Mat& picture, cv::Point centre, int radius, int gray) {
  const int n = picture.cols;
  for (int dy : {-n, 0, n}) {
    for (int dx : {-n, 0, n}) {
      const cv::Point c = centre + cv::Point(dx, dy);
      if (c.x < -radius || c.y < -radius || c.x >= n + radius || c.y >= n + radius) continue;
      cv::circle(picture, c, radius, cv::Scalar(gray), cv::FILLED, cv::LINE_AA);
    }
  }
}

// One crown: three discs, lighter towards the light.
void crown(cv::Mat& picture, cv::Point centre, int radius, int gray) {
  disc(picture, centre, radius, gray - 12);
  disc(picture, centre + cv::Point(-radius / 8, -radius / 8), radius * 3 / 4, gray);
  disc(picture, centre + cv::Point(-radius / 4, -radius / 4), radius * 2 / 5, gray + 12);
}

// Displaces each texel by smooth noise, so that crowns are not round.
cv::Mat crumple(const cv::Mat& picture, double amplitude_px, std::mt19937_64& generator) {
  constexpr int kMargin = 64;
  const cv::Size size = picture.size();
  cv::Mat map_x = amplitude_px * fractal_noise(size, 32, 4, 0.6, generator) + kMargin;
  cv::Mat map_y = amplitude_px * fractal_noise(size, 32, 4, 0.6, generator) + kMargin;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      map_x.at<float>(y, x) += static_cast<float>(x);
      map_y.at<float>(y, x) += static_cast<float>(y);
    }
  }
  cv::Mat wrapped, crumpled;
  cv::copyMakeBorder(picture, wrapped, kMargin, kMargin, kMargin, kMargin, cv::BORDER_WRAP);
  cv::remap(wrapped, crumpled, map_x, map_y, cv::INTER_LINEAR);
  return crumpled;
}

}  // namespace

cv::Mat fractal_noise(cv::Size size, double longest_px, double shortest_px, double roughness,
                      std::mt19937_64& generator) {
  cv::Mat sum = cv::Mat::zeros(size, CV_32F);
  double amplitude = 1.0;
  for (double wavelength = longest_px; wavelength >= shortest_px; wavelength /= 2) {
    sum += amplitude * octave(size, wavelength, generator);
    amplitude *= roughness;
  }
  cv::Scalar mean, deviation;
  cv::meanStdDev(sum, mean, deviation);
  return (sum - mean[0]) / deviation[0];
}

cv::Mat wood(int size, std::mt19937_64& generator) {
  const cv::Mat stand = fractal_noise({size, size}, size / 2.0, 64, 0.6, generator);
  const cv::Mat fine = fractal_noise({size, size}, 32, 2, 0.75, generator);
  cv::Mat picture(size, size, CV_8U, cv::Scalar(118));
  std::uniform_int_distribution<int> across(0, size - 1), radius(6, 20), tone(-12, 12);
  const int crowns = size * size / 200;
  for (int i = 0; i < crowns; ++i) {
    // From the top downwards: nearer trees are lower in the image and cover the farther ones.
    const cv::Point centre(across(generator),
                           static_cast<int>(static_cast<std::int64_t>(size) * i / crowns));
    const int r = radius(generator), t = tone(generator);
    const float density = stand.at<float>(centre);
    if (density < -1.1F) continue;  // a clearing
    crown(picture, centre, r, 96 + t + static_cast<int>(8 * density));
  }
  cv::Mat mixed;
  crumple(picture, 3.0, generator).convertTo(mixed, CV_32F);
  mixed += 7.0 * stand + 9.0 * fine;
  mixed.convertTo(picture, CV_8U);
  return picture;
}

std::vector<float> tree_tops(int length, std::mt19937_64& generator) {
  std::vector<float> tops(static_cast<std::size_t>(length), 0.0F);
  std::uniform_real_distribution<double> height(5.0, 38.0), width(6.0, 24.0);
  std::uniform_int_distribution<int> along(0, length - 1);
  for (int tree = 0; tree < length / 14; ++tree) {
    const double h = height(generator), w = width(generator);
    const int centre = along(generator);
    for (int dx = static_cast<int>(-w); dx <= static_cast<int>(w); ++dx) {
      auto& top = tops[static_cast<std::size_t>((centre + dx + length) % length)];
      top = std::max(top, static_cast<float>(h * std::sqrt(1.0 - dx * dx / (w * w))));
    }
  }
  return tops;
}

}  // namespace ols::sim
