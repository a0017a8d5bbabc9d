#include "land/staircases.h"

#include <algorithm>

namespace ols::land {

// Between the camera's foot and the first step the ground is level.
LandHeight Staircase::near_foot(double distance_m) const {
  const Height& first = heights_[0];
  if (first.elevation_rad >= 0.0F || !(distance_m > 0.0)) return {};
  const double nearer = distances_m_[0] / distance_m;
  return {std::atan(std::tan(double{first.elevation_rad}) * nearer), first.sd_rad * nearer};
}

double Staircase::greatest_sd_rad(std::size_t first, std::size_t last) const {
  const std::size_t from = first > 0 ? first - 1 : 0, end = std::min(last + 1, distances_m_.size());
  float greatest = 0.0F;
  for (std::size_t step = from; step < end; ++step)
    greatest = std::max(greatest, heights_[step].sd_rad);
  return greatest;
}

double Staircase::distance_at(double elevation_rad) const {
  const std::size_t step = count_while(
      [&](std::size_t before) { return heights_[before].elevation_rad < elevation_rad; });
  if (step == distances_m_.size()) return kNone;
  const double at_m = distances_m_[step], at_rad = heights_[step].elevation_rad;
  if (step == 0) return at_rad < 0.0 ? at_m * std::tan(at_rad) / std::tan(elevation_rad) : at_m;
  const double from_m = distances_m_[step - 1], from_rad = heights_[step - 1].elevation_rad;
  if (is_steep(step - 1) && at_m > from_m) {
    const double slope = (up_m(step) - up_m(step - 1)) / (at_m - from_m);
    return (up_m(step - 1) - slope * from_m) / (std::tan(elevation_rad) - slope);
  }
  return from_m + (elevation_rad - from_rad) / (at_rad - from_rad) * (at_m - from_m);
}

void Staircases::add(std::span<const Step> steps) {
  for (const Step& step : steps) {
    distances_m_.push_back(step.distance_m);
    heights_.push_back({step.elevation_rad, step.elevation_sd_rad});
  }
  begins_.push_back(static_cast<std::uint32_t>(distances_m_.size()));
}

}  // namespace ols::land
