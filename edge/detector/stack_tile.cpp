#include "edge/detector/stack_tile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>
#include <vector>

#include "edge/detector/binned_residual.h"

namespace ols::detector {
namespace {

using Stack = VelocityStack;

// A row of bins from (x, y) on; 0 outside the image.
void copy_row(const cv::Mat& residual, int x, int y, std::int16_t* out) {
  std::fill_n(out, Stack::kStride, std::int16_t{0});
  if (y < 0 || y >= residual.rows) return;
  const int from = std::clamp(-x, 0, Stack::kStride);
  const int to = std::clamp(residual.cols - x, from, Stack::kStride);
  const auto* row = residual.ptr<std::int16_t>(y);
  for (int i = from; i < to; ++i) out[i] = row[x + i];
}

std::int16_t quantile(std::vector<std::int16_t>& sample, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(sample.size()));
  std::nth_element(sample.begin(), sample.begin() + rank, sample.end());
  return sample[static_cast<std::size_t>(rank)];
}

}  // namespace

void StackTile::load(const ResidualPast& past, const cv::Point& corner) {
  const Eigen::Vector2d centre(2.0 * corner.x + Stack::kWidth, 2.0 * corner.y + Stack::kHeight);
  for (std::size_t age = 0; age < images_.size(); ++age) {
    const Eigen::Vector2d shift = past.shift_px(age, centre) / 2.0;
    const int x = corner.x - Stack::kMargin + static_cast<int>(std::lround(shift.x()));
    const int y = corner.y - Stack::kMargin + static_cast<int>(std::lround(shift.y()));
    for (int row = 0; row < Stack::kRows; ++row)
      copy_row(past.residual(age), x, y + row,
               images_.at(age).data() + std::ptrdiff_t{row} * Stack::kStride);
  }
}

// By a sorting network, which the processor runs for many bins at once.
void StackTile::find_median() {
  static constexpr std::array<std::pair<std::size_t, std::size_t>, 19> kNetwork{{{0, 1},
                                                                                 {2, 3},
                                                                                 {4, 5},
                                                                                 {6, 7},
                                                                                 {0, 2},
                                                                                 {1, 3},
                                                                                 {4, 6},
                                                                                 {5, 7},
                                                                                 {1, 2},
                                                                                 {5, 6},
                                                                                 {0, 4},
                                                                                 {3, 7},
                                                                                 {1, 5},
                                                                                 {2, 6},
                                                                                 {1, 4},
                                                                                 {3, 6},
                                                                                 {2, 4},
                                                                                 {3, 5},
                                                                                 {3, 4}}};
  constexpr std::size_t kBlock = 64;
  static_assert(std::tuple_size_v<Plane> % kBlock == 0);
  std::array<std::array<std::int16_t, kBlock>, Stack::kImages> sorted;
  for (std::size_t from = 0; from < median_.size(); from += kBlock) {
    for (std::size_t age = 0; age < sorted.size(); ++age)
      std::copy_n(images_[age].data() + from, kBlock, sorted[age].data());
    for (const auto& [first, second] : kNetwork) {
      auto* low = sorted[first].data();
      auto* high = sorted[second].data();
      for (std::size_t x = 0; x < kBlock; ++x) {
        const std::int16_t least = std::min(low[x], high[x]);
        high[x] = std::max(low[x], high[x]);
        low[x] = least;
      }
    }
    for (std::size_t x = 0; x < kBlock; ++x)
      median_[from + x] = static_cast<std::int16_t>((sorted[3][x] + sorted[4][x]) / 2);
  }
}

double StackTile::noise() const {
  constexpr double kLeast = 0.4 * BinnedResidual::kUnitsOfNoise;  // rounding alone: 0.29 levels
  constexpr double kMostTexture = 1.0;  // of the noise; 0.45 in white noise
  constexpr double kMostTail = 2.8;     // 95 % quantile by standard deviation; 2.35 in white noise
  constexpr double kSdOfMedian = 1.4826;
  constexpr int kStep = 3;
  std::vector<std::int16_t> deviations, texture;
  deviations.reserve(2048);
  texture.reserve(256);
  for (int y = Stack::kMargin; y < Stack::kMargin + Stack::kHeight; y += kStep) {
    for (int x = Stack::kMargin + y % kStep; x < Stack::kMargin + Stack::kWidth; x += kStep) {
      const auto place = static_cast<std::size_t>(y * Stack::kStride + x);
      texture.push_back(static_cast<std::int16_t>(std::abs(median_.at(place))));
      for (const Plane& image : images_)
        deviations.push_back(
            static_cast<std::int16_t>(std::abs(image.at(place) - median_.at(place))));
    }
  }
  const double sd = kSdOfMedian * quantile(deviations, 0.5);
  if (sd < kLeast || kSdOfMedian * quantile(texture, 0.5) > kMostTexture * sd) return 0.0;
  return quantile(deviations, 0.95) > kMostTail * sd ? 0.0 : sd;
}

bool StackTile::prepare(const ResidualPast& past, const cv::Point& corner, VelocityStack& stack) {
  load(past, corner);
  find_median();
  const double sd = noise();
  if (sd == 0.0) return false;
  // kScale * deviation / sd in 16 bits, which the processor does for many bins at once.
  constexpr int kMostDeviation = 4095;
  const auto factor = static_cast<std::int16_t>(kScale * 8192.0 / sd);
  for (std::size_t age = 0; age < images_.size(); ++age) {
    const auto* level = images_.at(age).data();
    const auto* usual = median_.data();
    auto* value = stack.image(age).data();
    for (std::size_t i = 0; i < median_.size(); ++i) {
      const int off = std::clamp(level[i] - usual[i], -kMostDeviation, kMostDeviation);
      const int scaled = (static_cast<std::int16_t>(8 * off) * factor) >> 16;
      value[i] = static_cast<std::uint8_t>(std::clamp(scaled + Stack::kZero, 0, 255));
    }
  }
  return true;
}

}  // namespace ols::detector
