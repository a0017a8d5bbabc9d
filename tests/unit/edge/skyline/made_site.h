// A station among random hills: the true hills, and a model of them with errors.
#pragma once

#include <cmath>

#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "land/column_march.h"
#include "land/horizon_map.h"
#include "sim/world/relief.h"
#include "tests/unit/land/made_land.h"

namespace ols::skyline {

inline constexpr double kModelSd_m = 4.0;

class MadeSite {
 public:
  explicit MadeSite(unsigned seed)
      : far_(200.0, 5000.0, 10 * seed),
        near_(20.0, 1200.0, 10 * seed + 1),
        error_(kModelSd_m, land::kLowered_m, 10 * seed + 2) {}

  land::MadeLand truth() const {
    return land::MadeLand([this](double lat, double lon) { return height_m(at(lat, lon)); });
  }
  land::MadeLand model() const {
    return land::MadeLand(
        [this](double lat, double lon) { return height_m(at(lat, lon)) + error_.at(at(lat, lon)); },
        kModelSd_m);
  }
  // The camera's position, 80 m above the true ground.
  Geodetic camera() const {
    Geodetic camera = kCentre;
    camera.height_m = height_m(Eigen::Vector2d::Zero()) + 80.0;
    return camera;
  }

  static inline const Geodetic kCentre{radians(46.0), radians(9.0), 0.0};

 private:
  static Eigen::Vector2d at(double latitude_rad, double longitude_rad) {
    constexpr double kRadius_m = 6'371'000.0;
    return kRadius_m *
           Eigen::Vector2d((longitude_rad - kCentre.longitude_rad) * std::cos(kCentre.latitude_rad),
                           latitude_rad - kCentre.latitude_rad);
  }
  double height_m(const Eigen::Vector2d& place_m) const {
    return 500.0 + far_.at(place_m) + near_.at(place_m);
  }

  sim::Waves far_, near_;
  sim::ErrorField error_;
};

// Coarse, so that the map is made quickly.
inline land::HorizonMapConfig quick_map() { return {.columns = 720, .reach_m = 10'000.0}; }

}  // namespace ols::skyline
