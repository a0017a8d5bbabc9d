// Buildings and woods: where they stand, and which of them a place is under.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

namespace ols::land {

enum class CoveringKind { kBuilding, kWood };

// Polygons of (longitude, latitude) [rad], outlines and holes alike: a place is inside if it is
// within an odd number of rings. A ring's last corner is joined to its first.
struct Covering {
  CoveringKind kind = CoveringKind::kBuilding;
  std::vector<std::vector<Eigen::Vector2d>> rings;
  double height_m = 0.0;  // above the ground; of a building, above the lowest ground at its corners
  double sd_m = 0.0;      // 1-sigma of it
};

// Finds coverings by place in a lattice of cells. Each cell has the edges that cross it, and for
// each polygon whether the cell's centre is inside: a look-up does not depend on how long outlines
// are.
class CoveringIndex {
 public:
  explicit CoveringIndex(const std::vector<Covering>& coverings);

  // Calls `take` with the number of each covering above this place.
  template <class Take>
  void for_each_at(const Eigen::Vector2d& place, Take take) const {
    const std::size_t cell = cell_of(place);
    if (cell == kOutside) return;
    for (std::uint32_t i = begins_[cell]; i < begins_[cell + 1]; ++i) {
      if (is_inside(parts_[i], place, cell)) take(parts_[i].covering);
    }
  }

 private:
  struct Edge {
    Eigen::Vector2d from, to;
  };
  struct Part {  // of one covering in one cell
    std::uint32_t cell, covering;
    std::uint32_t first_edge, edges;
    bool centre_inside;
  };
  static constexpr std::size_t kOutside = ~std::size_t{0};

  std::size_t cell_of(const Eigen::Vector2d& place) const;
  Eigen::Vector2d centre(std::size_t cell) const;
  bool is_inside(const Part& part, const Eigen::Vector2d& place, std::size_t cell) const;
  void lay_out(const std::vector<Covering>& coverings);
  void add(std::uint32_t number, const Covering& covering);

  Eigen::Vector2d south_west_{0.0, 0.0}, step_{1.0, 1.0}, per_step_{1.0, 1.0};
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<Part> parts_;            // by cell
  std::vector<std::uint32_t> begins_;  // of each cell in parts_, and the end
  std::vector<Edge> edges_;
};

}  // namespace ols::land
