// Medians. For an even number of values, the median is the upper one of the two middle values.
// Pure.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace ols {

// `values` must not be empty.
template <class Number>
Number median(std::vector<Number> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

// The median of each coordinate separately.
inline Eigen::Vector2d median(const std::vector<Eigen::Vector2d>& points) {
  std::vector<double> x, y;
  for (const Eigen::Vector2d& point : points) {
    x.push_back(point.x());
    y.push_back(point.y());
  }
  return {median(std::move(x)), median(std::move(y))};
}

}  // namespace ols
