// The bending of a line of sight by the air: to a place on or above the ground (terrestrial
// refraction), and to a celestial body (astronomical refraction). Applied only to the observations
// of a calibration; bearings are published without this correction.
#pragma once

#include <Eigen/Core>
#include <string>

namespace ols::calibration {

// The apparent lift [m] of a point seen from the origin, across the line of sight, for a refraction
// coefficient of 1: s^2 / R times the bend of the ray, where s is the distance. `enu_m`: the point
// (east, north, up).
Eigen::Vector3d terrestrial_lift_m(const Eigen::Vector3d& enu_m);

struct Air {
  double pressure_hPa = 1013.25;  // at the station, not reduced to sea level
  double temperature_degC = 10.0;
  double humidity = 0.5;  // 0..1
};
// The standard atmosphere at this height.
Air standard_air(double height_m);
// Why this cannot be the pressure at this height; empty: it can. Weather usually changes the
// pressure by less than 50 hPa; 70 are allowed. A pressure reduced to sea level, as weather
// services state it, is recognised where the station stands more than 600 m high.
std::string pressure_trouble(double pressure_hPa, double height_m);

inline constexpr double kWavelength_um = 0.55;  // wavelength of the light that the camera sees

// Refraction A tan z + B tan^3 z at the apparent zenith distance z (ERFA's eraRefco). It is wrong
// by arc seconds below 10 degrees of elevation.
class AstronomicalRefraction {
 public:
  explicit AstronomicalRefraction(const Air& air);
  // How much higher a body appears than it would without air [rad].
  double lift_rad(double true_zenith_rad) const;

 private:
  double A_ = 0.0, B_ = 0.0;
};

}  // namespace ols::calibration
