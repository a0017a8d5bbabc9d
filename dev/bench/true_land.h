// A land that differs from its model as the model says that it may. Pure.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "geometry/wgs84.h"
#include "land/surface.h"
#include "sim/world/relief.h"

namespace ols::bench {

// `factor`: its errors over those that the model states; `length_m`: over which they are alike.
class TrueLand : public land::Surface {
 public:
  TrueLand(const land::Surface& model, const Geodetic& centre, double factor, double length_m,
           unsigned seed)
      : model_(model), frame_(centre), errors_(factor, length_m, seed) {}

  std::optional<land::SurfaceHeight> ground(double latitude_rad,
                                            double longitude_rad) const override {
    auto known = model_.ground(latitude_rad, longitude_rad);
    constexpr double kSea_m = 61.0;  // above the ellipsoid there
    if (!known || known->height_m < kSea_m) return known;
    const Eigen::Vector2d at =
        frame_.to_enu(ecef_from_geodetic({latitude_rad, longitude_rad, 0.0})).head<2>();
    known->height_m += known->sd_m * errors_.at(at);
    known->sd_m = 0.0;
    return known;
  }
  std::optional<land::SurfaceHeight> top(double latitude_rad, double longitude_rad) const override {
    return ground(latitude_rad, longitude_rad);
  }

 private:
  const land::Surface& model_;
  LocalFrame frame_;
  sim::ErrorField errors_;
};

}  // namespace ols::bench
