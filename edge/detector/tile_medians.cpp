#include "edge/detector/tile_medians.h"

#include <algorithm>

namespace ols::detector {
namespace {

// The upper median, by bisection of its value: counting takes the processor a fraction of the time
// of std::nth_element().
std::int16_t median_of(const std::vector<std::int16_t>& sample) {
  std::int16_t low = sample.front(), high = low;
  for (const std::int16_t value : sample) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  while (low < high) {
    const auto middle = static_cast<std::int16_t>(low + (high - low) / 2);
    std::int16_t count = 0;  // of 16 bits like the values, for speed
    for (const std::int16_t value : sample)
      count = static_cast<std::int16_t>(count + (value <= middle ? 1 : 0));
    if (static_cast<std::size_t>(count) > sample.size() / 2) {
      high = middle;
    } else {
      low = static_cast<std::int16_t>(middle + 1);
    }
  }
  return low;
}

}  // namespace

void TileMedians::begin(const cv::Mat& values) {
  constexpr int kTile = 24;  // [px]
  values_ = values;
  columns_ = std::max(1, values.cols / kTile);
  rows_ = std::max(1, values.rows / kTile);
  medians_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), {});
}

cv::Rect TileMedians::tile(int column, int row) const {
  const cv::Point from(column * values_.cols / columns_, row * values_.rows / rows_);
  const cv::Point to((column + 1) * values_.cols / columns_, (row + 1) * values_.rows / rows_);
  return {from, to};
}

std::int16_t TileMedians::largest_nearby(const cv::Point& pixel) {
  const int column = pixel.x * columns_ / values_.cols, row = pixel.y * rows_ / values_.rows;
  std::int16_t largest = 0;
  for (int j = std::max(0, row - 1); j <= std::min(rows_ - 1, row + 1); ++j) {
    for (int i = std::max(0, column - 1); i <= std::min(columns_ - 1, column + 1); ++i) {
      largest = std::max(largest, median(i, j));
    }
  }
  return largest;
}

// Samples every third pixel of every third row.
std::int16_t TileMedians::median(int column, int row) {
  auto& known = medians_.at(static_cast<std::size_t>(row * columns_ + column));
  if (known) return *known;
  constexpr int kStep = 3;
  const cv::Rect part = tile(column, row);
  const int across = (part.width + kStep - 1) / kStep, down = (part.height + kStep - 1) / kStep;
  sample_.resize(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
  auto* next = sample_.data();
  for (int y = part.y; y < part.br().y; y += kStep) {
    const auto* values = values_.ptr<std::int16_t>(y) + part.x;
    for (int i = 0; i < across; ++i) *next++ = values[kStep * i];
  }
  return *(known = median_of(sample_));
}

}  // namespace ols::detector
