// Draws an instant into a picture, as black and white squares that survive every video encoder.
// Tests and measurements compare this instant with the station's time stamp of the picture. Pure.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace ols::sim {

inline constexpr int kSquare_px = 16;
inline constexpr int kSquaresInRow = 12, kSquares = 48;

inline cv::Rect time_square(int bit) {
  return {kSquare_px * (bit % kSquaresInRow), kSquare_px * (bit / kSquaresInRow), kSquare_px,
          kSquare_px};
}

// Draws into the upper left corner of a gray picture of at least 192 x 64 px.
inline void draw_time(std::int64_t microseconds, cv::Mat& gray) {
  for (int bit = 0; bit < kSquares; ++bit)
    gray(time_square(bit)).setTo((microseconds >> bit & 1) != 0 ? 230 : 20);
}

inline std::int64_t time_in(const cv::Mat& gray) {
  std::int64_t microseconds = 0;
  for (int bit = 0; bit < kSquares; ++bit) {
    const cv::Rect square = time_square(bit);
    const bool white =
        gray.at<std::uint8_t>(square.y + square.height / 2, square.x + square.width / 2) > 128;
    if (white) microseconds |= std::int64_t{1} << bit;
  }
  return microseconds;
}

}  // namespace ols::sim
