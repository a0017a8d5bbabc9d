// Computes the medians of an image's tiles, only where they are needed. Each tile is about 24
// pixels wide and high. Its median is taken over every third pixel of every third row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace ols::detector {

class TileMedians {
 public:
  // `values`: CV_16S; must not change while this object is in use.
  void begin(const cv::Mat& values);
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  cv::Rect tile(int column, int row) const;  // [px]
  std::int16_t median(int column, int row);
  // The largest median among the tile at a pixel and its neighbours.
  std::int16_t largest_nearby(const cv::Point& pixel);

 private:
  cv::Mat values_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::optional<std::int16_t>> medians_;  // row by row
  std::vector<std::int16_t> sample_;
};

}  // namespace ols::detector
