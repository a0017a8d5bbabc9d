#include "calibration/refraction.h"

#include <erfa.h>

#include <algorithm>
#include <cmath>

#include "conditions/printed.h"
#include "geometry/direction.h"

namespace ols::calibration {
namespace {

constexpr double kEarthRadius_m = 6371000.0;
constexpr double kScaleHeight_m = 8000.0;  // of the air's density

// The bend of a ray over k s / R: 1/2 along the ground; less towards thin air, whose density falls
// off exponentially: the integral of (1 - u) exp(-u rise / H) over the ray.
double bend(double rise_m) {
  const double a = rise_m / kScaleHeight_m;
  if (std::abs(a) < 1e-3) return 0.5 - a / 6.0;
  return (a - 1.0 + std::exp(-a)) / (a * a);
}

}  // namespace

Eigen::Vector3d terrestrial_lift_m(const Eigen::Vector3d& enu_m) {
  const double distance_m = enu_m.norm();
  const Eigen::Vector3d up = tangent_basis(azimuth_elevation_from_enu(enu_m)).col(1);
  return distance_m * distance_m / kEarthRadius_m * bend(enu_m.z()) * up;
}

Air standard_air(double height_m) {
  // International standard atmosphere, troposphere.
  const double lapse_K_m = 6.5e-3, sea_level_K = 288.15;
  const double temperature_K = sea_level_K - lapse_K_m * height_m;
  Air air;
  air.pressure_hPa = 1013.25 * std::pow(temperature_K / sea_level_K, 5.2559);
  air.temperature_degC = temperature_K - 273.15;
  return air;
}

std::string pressure_trouble(double pressure_hPa, double height_m) {
  constexpr double kWeather_hPa = 70.0, kSeaLevel_hPa = 1013.25;
  const double usual_hPa = standard_air(height_m).pressure_hPa;
  if (std::abs(pressure_hPa - usual_hPa) <= kWeather_hPa) return {};
  std::string text =
      printed("%.1f hPa cannot be the pressure at %.0f m, where it is about %.0f hPa", pressure_hPa,
              height_m, usual_hPa);
  if (std::abs(pressure_hPa - kSeaLevel_hPa) <= kWeather_hPa) {
    text += printed(
        ": it looks reduced to sea level, as weather services state it; at the station "
        "that is %.1f hPa",
        pressure_hPa * usual_hPa / kSeaLevel_hPa);
  }
  return text;
}

AstronomicalRefraction::AstronomicalRefraction(const Air& air) {
  eraRefco(air.pressure_hPa, air.temperature_degC, air.humidity, kWavelength_um, &A_, &B_);
}

double AstronomicalRefraction::lift_rad(double true_zenith_rad) const {
  double lift = 0.0;
  constexpr double kSafe_rad = 1.5;  // the tangent is not used near the horizon
  for (int i = 0; i < 10; ++i) {
    const double t = std::tan(std::min(true_zenith_rad - lift, kSafe_rad));
    lift = A_ * t + B_ * t * t * t;
  }
  return lift;
}

}  // namespace ols::calibration
