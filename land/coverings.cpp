#include "land/coverings.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace ols::land {
namespace {

constexpr double kCell_rad = 60.0 / 6'371'000.0;  // a building or two
constexpr double kMostCells = 4e6;

template <class Take>
void for_each_edge(const Covering& covering, Take take) {
  for (const auto& ring : covering.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) take(ring[i], ring[(i + 1) % ring.size()]);
  }
}

// Whether the edge passes from one side of `at` to the other along an axis; a corner belongs to one
// side. And where it does so on the other axis.
bool crosses(const Eigen::Vector2d& from, const Eigen::Vector2d& to, int axis, double at) {
  return (from[axis] <= at) != (to[axis] <= at);
}
double crossing(const Eigen::Vector2d& from, const Eigen::Vector2d& to, int axis, double at) {
  const int other = 1 - axis;
  return from[other] + (at - from[axis]) / (to[axis] - from[axis]) * (to[other] - from[other]);
}

bool is_between(double value, double a, double b) { return (a < value) != (b < value); }

}  // namespace

CoveringIndex::CoveringIndex(const std::vector<Covering>& coverings) {
  lay_out(coverings);
  for (std::size_t i = 0; i < coverings.size(); ++i) {
    add(static_cast<std::uint32_t>(i), coverings[i]);
  }
  std::ranges::stable_sort(parts_, {}, &Part::cell);
  begins_.assign(columns_ * rows_ + 1, 0);
  for (const Part& part : parts_) ++begins_[part.cell + 1];
  for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
}

void CoveringIndex::lay_out(const std::vector<Covering>& coverings) {
  Eigen::Vector2d least(1e9, 1e9), greatest(-1e9, -1e9);
  for (const Covering& covering : coverings) {
    for_each_edge(covering, [&](const Eigen::Vector2d& from, const Eigen::Vector2d&) {
      least = least.cwiseMin(from);
      greatest = greatest.cwiseMax(from);
    });
  }
  if (!(least.x() <= greatest.x())) return;
  const Eigen::Vector2d size = greatest - least;
  step_ = {kCell_rad / std::max(0.01, std::cos(least.y())), kCell_rad};
  const double cells = (size.x() / step_.x() + 1.0) * (size.y() / step_.y() + 1.0);
  if (cells > kMostCells) step_ *= std::sqrt(cells / kMostCells);
  per_step_ = step_.cwiseInverse();
  south_west_ = least;
  columns_ = static_cast<std::size_t>(size.x() / step_.x()) + 1;
  rows_ = static_cast<std::size_t>(size.y() / step_.y()) + 1;
}

std::size_t CoveringIndex::cell_of(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d at = (place - south_west_).cwiseProduct(per_step_);
  if (!(at.x() >= 0.0 && at.y() >= 0.0)) return kOutside;
  const auto column = static_cast<std::size_t>(at.x()), row = static_cast<std::size_t>(at.y());
  return column < columns_ && row < rows_ ? row * columns_ + column : kOutside;
}

Eigen::Vector2d CoveringIndex::centre(std::size_t cell) const {
  const Eigen::Vector2d at(static_cast<double>(cell % columns_) + 0.5,
                           static_cast<double>(cell / columns_) + 0.5);
  return south_west_ + at.cwiseProduct(step_);
}

void CoveringIndex::add(std::uint32_t number, const Covering& covering) {
  struct Found {
    std::vector<Edge> edges;
    bool centre_inside = false;
  };
  std::map<std::size_t, Found> cells;
  std::map<std::size_t, std::vector<double>> crossings;  // of the rows' middles
  const auto column_of = [&](double x) {
    const double at = (x - south_west_.x()) * per_step_.x();
    return std::min(static_cast<std::size_t>(std::max(at, 0.0)), columns_ - 1);
  };
  const auto row_of = [&](double y) {
    const double at = (y - south_west_.y()) * per_step_.y();
    return std::min(static_cast<std::size_t>(std::max(at, 0.0)), rows_ - 1);
  };
  for_each_edge(covering, [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const double low = std::min(from.y(), to.y()), high = std::max(from.y(), to.y());
    for (std::size_t row = row_of(low); row <= row_of(high); ++row) {
      const double south = south_west_.y() + static_cast<double>(row) * step_.y();
      const auto x_at = [&](double y) { return crossing(from, to, 1, std::clamp(y, low, high)); };
      const auto [west, east] = low < high ? std::minmax({x_at(south), x_at(south + step_.y())})
                                           : std::minmax({from.x(), to.x()});
      for (std::size_t column = column_of(west); column <= column_of(east); ++column) {
        cells[row * columns_ + column].edges.push_back({from, to});
      }
      const double middle = south + 0.5 * step_.y();
      if (crosses(from, to, 1, middle)) {
        crossings[row].push_back(crossing(from, to, 1, middle));
      }
    }
  });
  for (auto& [row, at] : crossings) {
    std::ranges::sort(at);
    for (std::size_t column = column_of(at.front()); column <= column_of(at.back()); ++column) {
      const std::size_t cell = row * columns_ + column;
      const auto west = std::ranges::lower_bound(at, centre(cell).x()) - at.begin();
      if (west % 2 == 1) cells[cell].centre_inside = true;
    }
  }
  for (const auto& [cell, found] : cells) {
    parts_.push_back({static_cast<std::uint32_t>(cell), number,
                      static_cast<std::uint32_t>(edges_.size()),
                      static_cast<std::uint32_t>(found.edges.size()), found.centre_inside});
    edges_.insert(edges_.end(), found.edges.begin(), found.edges.end());
  }
}

// From the cell's centre east or west, then north or south: each edge crossed changes sides.
bool CoveringIndex::is_inside(const Part& part, const Eigen::Vector2d& place,
                              std::size_t cell) const {
  const Eigen::Vector2d middle = centre(cell);
  bool inside = part.centre_inside;
  for (std::uint32_t i = part.first_edge; i < part.first_edge + part.edges; ++i) {
    const auto& [from, to] = edges_[i];
    if (crosses(from, to, 1, middle.y()) &&
        is_between(crossing(from, to, 1, middle.y()), middle.x(), place.x())) {
      inside = !inside;
    }
    if (crosses(from, to, 0, place.x()) &&
        is_between(crossing(from, to, 0, place.x()), middle.y(), place.y())) {
      inside = !inside;
    }
  }
  return inside;
}

}  // namespace ols::land
