// The coverings of the land (buildings, woods, and scenery that stations have measured), and a
// search for the coverings above a place.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

namespace ols::land {

// kScenery: a point that two stations have seen (land/scenery/scenery_ranges.h).
enum class CoveringKind { kBuilding, kWood, kScenery };

// One or more rings of corners (longitude, latitude) [rad]. Outer rings and holes are not
// distinguished: a place is inside if an odd number of rings contain it. A ring's last corner is
// joined to its first.
struct Covering {
  CoveringKind kind = CoveringKind::kBuilding;
  std::vector<std::vector<Eigen::Vector2d>> rings;
  // Height of the top above the ground; for a building, above the lowest ground at its corners; for
  // scenery, above the WGS84 ellipsoid.
  double height_m = 0.0;
  double sd_m = 0.0;  // 1-sigma of height_m
};

// Finds coverings by place, in a lattice of cells. For each covering in a cell, the cell stores
// those edges of the covering that cross the cell, and whether the cell's centre is inside the
// covering. A look-up therefore takes the same time however long the outlines are.
class CoveringIndex {
 public:
  explicit CoveringIndex(const std::vector<Covering>& coverings);

  // Calls `take` with the index of each covering above this place.
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
  struct Part {  // the part of one covering that is in one cell
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
  std::vector<Part> parts_;            // sorted by cell
  std::vector<std::uint32_t> begins_;  // index into parts_ of each cell's first part, then the end
  std::vector<Edge> edges_;
};

}  // namespace ols::land
