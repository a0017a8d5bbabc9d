// The crest that makes the skyline of the land at one azimuth, with what its elevation depends on.
// Pure.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "land/horizon_map.h"

namespace ols::skyline {

struct ModelledCrest {
  double elevation_rad = 0.0;
  double slope = 0.0;                                 // of the skyline: elevation by azimuth
  Eigen::Vector2d place_m = Eigen::Vector2d::Zero();  // from the camera: east, north
  // Of seen minus modelled elevation: by the camera's offset in the model [rad/m], east, north, up,
  // and by the coefficient of refraction.
  Eigen::RowVector3d by_place = Eigen::RowVector3d::Zero();
  double by_refraction = 0.0;
  double model_sd_rad = 0.0;  // 1-sigma of the elevation, without refraction; alike along the crest
  // Variance of what is not alike: trees, and what is between the model's heights.
  double rough_rad2 = 0.0;
};

// nullopt if the land there is unknown.
std::optional<ModelledCrest> crest_at(const land::HorizonMap& map, double azimuth_rad);

}  // namespace ols::skyline
