#include "edge/detector/box_residual.h"

#include <algorithm>
#include <cstddef>
#include <opencv2/imgproc.hpp>

namespace ols::detector {
namespace {

// `value` * factor / 2^16 in 16 bits, which the processor does for many pixels at once.
std::uint16_t scaled(std::uint16_t value, std::uint32_t factor) {
  return static_cast<std::uint16_t>((value * factor) >> 16U);
}

// |mean of 9 - mean of 120|, by their sums.
std::int16_t difference(std::uint16_t nine, std::uint16_t ring) {
  constexpr std::uint32_t kShift = 4;  // keeps the digits of the smaller sum
  constexpr std::uint32_t kNinth = BoxResidual::kUnits * (65536U >> kShift) / 9;
  constexpr std::uint32_t kRing = (BoxResidual::kUnits * 65536U + 60) / 120;
  const auto apart = static_cast<std::int16_t>(
      scaled(static_cast<std::uint16_t>(nine << kShift), kNinth) - scaled(ring, kRing));
  return std::max<std::int16_t>(apart, static_cast<std::int16_t>(-apart));
}

}  // namespace

void BoxResidual::start(int width) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    auto& columns = rows_.at(i).columns;
    columns.assign(static_cast<std::size_t>(width), 0);
    rows_.at(i).pairs.resize(columns.size());
    rows_.at(i).fours.resize(columns.size());
    const int above = kReach - kSides.at(i) / 2;  // rows of the outer box above this one
    for (int y = above; y < above + kSides.at(i) - 1; ++y) {
      const auto* added = padded_.ptr<std::uint8_t>(y);
      for (std::size_t x = 0; x < columns.size(); ++x) columns[x] += added[x];
    }
  }
}

// `y` is a row of the residual. Its outer box begins in the same row of the padded image.
void BoxResidual::advance(int y) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const int above = kReach - kSides.at(i) / 2;
    auto* columns = rows_.at(i).columns.data();
    const std::size_t count = rows_.at(i).columns.size();
    const auto* added = padded_.ptr<std::uint8_t>(y + above + kSides.at(i) - 1);
    if (y == 0) {
      for (std::size_t x = 0; x < count; ++x) columns[x] += added[x];
      continue;
    }
    const auto* left = padded_.ptr<std::uint8_t>(y + above - 1);
    for (std::size_t x = 0; x < count; ++x) {
      columns[x] = static_cast<std::uint16_t>(columns[x] + added[x] - left[x]);
    }
  }
}

void BoxResidual::add_up(Row& row) const {
  const std::size_t count = row.columns.size();
  const auto* columns = row.columns.data();
  auto* pairs = row.pairs.data();
  auto* fours = row.fours.data();
  for (std::size_t x = 0; x + 1 < count; ++x) {
    pairs[x] = static_cast<std::uint16_t>(columns[x] + columns[x + 1]);
  }
  for (std::size_t x = 0; x + 3 < count; ++x) {
    fours[x] = static_cast<std::uint16_t>(pairs[x] + pairs[x + 2]);
  }
}

void BoxResidual::measure(const cv::Mat& gray) {
  cv::copyMakeBorder(gray, padded_, kReach, kReach, kReach, kReach, cv::BORDER_REPLICATE);
  residual_.create(gray.size(), CV_16S);
  start(padded_.cols);
  const auto& [three, seven, thirteen] = rows_;
  for (int y = 0; y < gray.rows; ++y) {
    advance(y);
    for (std::size_t i = 1; i < rows_.size(); ++i) add_up(rows_.at(i));
    const auto *c3 = three.columns.data(), *c7 = seven.columns.data(),
               *c13 = thirteen.columns.data();
    const auto *p7 = seven.pairs.data(), *f7 = seven.fours.data(), *f13 = thirteen.fours.data();
    auto* out = residual_.ptr<std::int16_t>(y);
    for (int x = 0; x < gray.cols; ++x) {
      const auto inner = static_cast<std::uint16_t>(c3[x + 5] + c3[x + 6] + c3[x + 7]);
      const auto ring = static_cast<std::uint16_t>(f13[x] + f13[x + 4] + f13[x + 8] + c13[x + 12] -
                                                   f7[x + 3] - p7[x + 7] - c7[x + 9]);
      out[x] = difference(inner, ring);
    }
  }
}

}  // namespace ols::detector
