// The staircases of a camera's map (land/staircase.h), one for each column, laid out for look-ups:
// a look-up reads few lines of memory, because the map is larger than a processor's caches.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/angles.h"
#include "land/staircase.h"

namespace ols::land {

// The land of one column up to some distance.
struct LandHeight {
  double elevation_rad = -0.5 * kPi;
  double sd_rad = 0.0;  // 1-sigma
};

// One column. Not valid longer than the map. The distances stand apart, because most searches are
// for a distance.
class Staircase {
 public:
  struct Height {
    float elevation_rad, sd_rad;
  };
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  Staircase(std::span<const float> distances_m, const Height* heights)
      : distances_m_(distances_m), heights_(heights) {}

  bool empty() const { return distances_m_.empty(); }
  // The first step beyond this distance; the number of steps if there is none.
  std::size_t beyond(double distance_m) const {
    return count_while([&](std::size_t step) { return distances_m_[step] <= distance_m; });
  }
  // The same, for a distance that is not less than the one for which `step` was found.
  std::size_t beyond_from(std::size_t step, double distance_m) const {
    while (step < distances_m_.size() && distances_m_[step] <= distance_m) ++step;
    return step;
  }
  // `step`: the first step beyond this distance.
  LandHeight before(std::size_t step, double distance_m) const {
    if (step == distances_m_.size()) {
      return {heights_[step - 1].elevation_rad, heights_[step - 1].sd_rad};
    }
    if (step == 0) return near_foot(distance_m);
    const Height &from = heights_[step - 1], &to = heights_[step];
    const double from_m = distances_m_[step - 1];
    const double share = (distance_m - from_m) / (distances_m_[step] - from_m);
    const auto mix = [&](double at_from, double at_to) {
      return at_from + share * (at_to - at_from);
    };
    const double sd_rad = mix(from.sd_rad, to.sd_rad);
    if (!is_steep(step - 1)) return {mix(from.elevation_rad, to.elevation_rad), sd_rad};
    return {std::atan(mix(up_m(step - 1), up_m(step)) / distance_m), sd_rad};
  }
  // The greatest 1-sigma of the land between two distances; `first` and `last`: the first steps
  // beyond them. It may exceed that at both: a crest that is surely known may follow a wood.
  double greatest_sd_rad(std::size_t first, std::size_t last) const;
  // The first distance where the land is as high; kNone above the skyline.
  double distance_at(double elevation_rad) const;

 private:
  // The number of steps for which `is_before` is true; they are the first ones. Without branches: a
  // processor guesses every second one wrong.
  template <class IsBefore>
  std::size_t count_while(IsBefore is_before) const {
    std::size_t first = 0, count = distances_m_.size();
    while (count > 1) {
      const std::size_t half = count / 2;
      first += is_before(first + half - 1) ? half : 0;
      count -= half;
    }
    return first + (count == 1 && is_before(first) ? 1 : 0);
  }
  // Steeply below the camera a cell is many degrees high. There the land is straight between two
  // steps, not its elevation.
  bool is_steep(std::size_t step) const {
    return heights_[step].elevation_rad < -0.25F * static_cast<float>(kPi);
  }
  double up_m(std::size_t step) const {
    return distances_m_[step] * std::tan(double{heights_[step].elevation_rad});
  }
  LandHeight near_foot(double distance_m) const;

  std::span<const float> distances_m_;
  const Height* heights_;  // as many as distances
};

class Staircases {
 public:
  // The next column. It may be empty.
  void add(std::span<const Step> steps);

  Staircase operator[](std::size_t column) const {
    const std::size_t from = begins_[column];
    return {std::span(distances_m_).subspan(from, begins_[column + 1] - from), &heights_[from]};
  }
  std::size_t step_count() const { return distances_m_.size(); }

 private:
  std::vector<std::uint32_t> begins_{0};  // index of each column's first step, then the end
  std::vector<float> distances_m_;
  std::vector<Staircase::Height> heights_;
};

}  // namespace ols::land
