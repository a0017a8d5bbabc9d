#include "edge/skyline/modelled_crest.h"

#include <algorithm>
#include <cmath>

#include "edge/skyline/expected_skyline.h"
#include "geometry/angles.h"
#include "land/column_march.h"

namespace ols::skyline {
namespace {

// Between the azimuths where the skyline is kSmooth_m away on both sides. The errors of a model
// make its skyline rough: a slope over less would be of these errors, and would seem to tell much.
std::optional<double> slope_at(const land::HorizonMap& map, double azimuth_rad, double distance_m) {
  constexpr double kSmooth_m = land::kLowered_m / 3.0;
  constexpr double kLeast_rad = radians(0.1), kMost_rad = radians(5.0);
  const double step_rad = std::clamp(kSmooth_m / distance_m, kLeast_rad, kMost_rad);
  const auto left = map.skyline(azimuth_rad - step_rad);
  const auto right = map.skyline(azimuth_rad + step_rad);
  if (!left || !right) return std::nullopt;
  return (right->elevation_rad - left->elevation_rad) / (2.0 * step_rad);
}

}  // namespace

std::optional<ModelledCrest> crest_at(const land::HorizonMap& map, double azimuth_rad) {
  constexpr double kRough = 0.5;  // of the model's error
  const auto skyline = uncertain_skyline(map, azimuth_rad);
  if (!skyline) return std::nullopt;
  const double d = std::max(1.0, skyline->distance_m), rise = std::tan(skyline->elevation_rad);
  const auto slope = slope_at(map, azimuth_rad, d);
  if (!slope) return std::nullopt;
  const double s = std::sin(azimuth_rad), c = std::cos(azimuth_rad);
  ModelledCrest crest;
  crest.elevation_rad = skyline->elevation_rad;
  crest.slope = *slope;
  crest.place_m = d * Eigen::Vector2d(s, c);
  crest.by_place << (*slope * c + rise * s) / d, (-*slope * s + rise * c) / d, -1.0 / d;
  crest.by_refraction = land::refraction_slope(1.0, d);
  const double bent_rad = map.config().refraction_k_sd * crest.by_refraction;
  const double sd_rad = skyline->elevation_sd_rad;
  crest.model_sd_rad = std::sqrt(std::max(0.0, sd_rad * sd_rad - bent_rad * bent_rad));
  crest.rough_rad2 = std::pow(kRough * crest.model_sd_rad, 2);
  return crest;
}

}  // namespace ols::skyline
