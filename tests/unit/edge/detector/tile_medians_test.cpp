#include "edge/detector/tile_medians.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace ols::detector {
namespace {

TEST(TileMedians, AreThoseOfEveryThirdPixelOfEveryThirdRow) {
  cv::RNG random(5);
  for (const cv::Size& size : {cv::Size(24, 24), cv::Size(100, 77), cv::Size(47, 40)}) {
    for (const int most : {2, 30000}) {
      cv::Mat_<std::int16_t> values(size);
      random.fill(values, cv::RNG::UNIFORM, 0, most);
      TileMedians medians;
      medians.begin(values);
      for (int row = 0; row < medians.rows(); ++row) {
        for (int column = 0; column < medians.columns(); ++column) {
          const cv::Rect tile = medians.tile(column, row);
          std::vector<std::int16_t> sample;
          for (int y = tile.y; y < tile.br().y; y += 3) {
            for (int x = tile.x; x < tile.br().x; x += 3) sample.push_back(values(y, x));
          }
          std::sort(sample.begin(), sample.end());
          EXPECT_EQ(medians.median(column, row), sample[sample.size() / 2]) << size << most;
        }
      }
    }
  }
}

}  // namespace
}  // namespace ols::detector
