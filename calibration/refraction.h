// How the air bends a line of sight: to a place on or above the ground (terrestrial refraction),
// and to a celestial body (astronomical refraction). Used only for the observations of a
// calibration; bearings are sent out as observed.
#pragma once

#include <Eigen/Core>

namespace ols::calibration {

// The apparent lift of a point seen from the origin [m], across the line of sight, for a refraction
// coefficient of 1: s^2 / R times the bend of the ray, at the distance s. `enu_m`: the point, east,
// north, up.
Eigen::Vector3d terrestrial_lift_m(const Eigen::Vector3d& enu_m);

struct Air {
  double pressure_hPa = 1013.25;  // at the station, not reduced to sea level
  double temperature_degC = 10.0;
  double humidity = 0.5;  // 0..1
};
// The standard atmosphere at this height.
Air standard_air(double height_m);

inline constexpr double kWavelength_um = 0.55;  // of the light that the camera sees

// A tan z + B tan^3 z of the apparent zenith distance z (ERFA's eraRefco). Wrong by arc seconds
// below 10 degrees of elevation.
class AstronomicalRefraction {
 public:
  explicit AstronomicalRefraction(const Air& air);
  // By how much a body appears higher than without air [rad].
  double lift_rad(double true_zenith_rad) const;

 private:
  double A_ = 0.0, B_ = 0.0;
};

}  // namespace ols::calibration
