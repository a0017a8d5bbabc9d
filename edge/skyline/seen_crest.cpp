#include "edge/skyline/seen_crest.h"

#include <algorithm>
#include <cmath>

#include "edge/skyline/expected_skyline.h"
#include "geometry/angles.h"

namespace ols::skyline {
namespace {

constexpr double kSigmas = 3.0;

// Of the elevation, by the error of the azimuth.
double across_sd_rad(const SeenPlace& seen, const land::HorizonMap& map) {
  constexpr double kStep_rad = radians(0.1);
  const auto left = map.skyline(seen.direction.azimuth_rad - kStep_rad);
  const auto right = map.skyline(seen.direction.azimuth_rad + kStep_rad);
  if (!left || !right) return 0.0;
  const double slope = (right->elevation_rad - left->elevation_rad) / (2.0 * kStep_rad);
  return std::abs(slope) * std::sqrt(seen.azimuth_variance_rad2);
}

// The farthest place, up to the map's crest, where something kTallest_m high reaches the elevation.
double farthest_m(const land::HorizonMap& map, const AzimuthElevation& top, double crest_m) {
  constexpr double kStep = 0.95, kNearest_m = 1.0;
  double distance_m = crest_m;
  for (; distance_m > kNearest_m; distance_m *= kStep) {
    const auto base = map.highest_before(top.azimuth_rad, distance_m);
    if (!base) break;
    if (std::tan(base->elevation_rad) + kTallest_m / distance_m >= std::tan(top.elevation_rad))
      break;
  }
  return std::max(kNearest_m, distance_m);
}

}  // namespace

std::optional<land::SeenCrest> seen_crest(const SeenPlace& seen, double elevation_sd_rad,
                                          const land::HorizonMap& map) {
  const auto model = uncertain_skyline(map, seen.direction.azimuth_rad);
  if (!model) return std::nullopt;
  // At one place, an edge is found wrong in about the same way in each picture.
  const double seen_rad2 = seen.pictures * seen.variance_rad2 +
                           elevation_sd_rad * elevation_sd_rad +
                           std::pow(across_sd_rad(seen, map), 2);
  const double model_rad2 = model->elevation_sd_rad * model->elevation_sd_rad;
  const double above_rad = seen.direction.elevation_rad - model->elevation_rad;
  land::SeenCrest crest{.elevation_rad = seen.direction.elevation_rad,
                        .sd_rad = std::sqrt(seen_rad2)};
  crest.disagrees = above_rad * above_rad > kSigmas * kSigmas * (seen_rad2 + model_rad2);
  if (!crest.disagrees) {
    const double share = model_rad2 / (seen_rad2 + model_rad2);
    crest.elevation_rad = model->elevation_rad + share * above_rad;
    crest.sd_rad = std::sqrt(share * seen_rad2);
    crest.hides_from_m = model->distance_m;
  } else if (above_rad > 0.0) {
    crest.hides_from_m = farthest_m(map, seen.direction, model->distance_m);
  }
  return crest;
}

}  // namespace ols::skyline
