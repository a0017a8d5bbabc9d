// How the air bends a line of sight: to a point on or near the ground (terrestrial refraction), and
// to a celestial body (astronomical refraction). Only the observations of a calibration are
// corrected for refraction; published bearings are not.
#pragma once

#include <Eigen/Core>
#include <string>

namespace ols::calibration {

// The apparent lift [m], across the line of sight, of a point seen from the origin, for a
// refraction coefficient of 1. It is s^2 / R times a factor: 1/2 along the ground, less for high
// points, because the air is thinner there. s is the distance, R the radius of the Earth. `enu_m`:
// the point (east, north, up).
Eigen::Vector3d terrestrial_lift_m(const Eigen::Vector3d& enu_m);

struct Air {
  double pressure_hPa = 1013.25;  // at the station, not reduced to sea level
  double temperature_degC = 10.0;
  double humidity = 0.5;  // 0..1
};
// The standard atmosphere at this height.
Air standard_air(double height_m);
// Why this cannot be the pressure at this height; empty if it can. Weather usually changes the
// pressure by less than 50 hPa; 70 hPa are allowed. If the station is more than 600 m above sea
// level, a pressure that is reduced to sea level (as weather services state it) is recognised.
std::string pressure_trouble(double pressure_hPa, double height_m);

inline constexpr double kWavelength_um = 0.55;  // wavelength of the light that the camera sees

// Refraction A tan z + B tan^3 z at the apparent zenith distance z (ERFA's eraRefco). Below an
// elevation of 10 degrees, this formula is wrong by some arc seconds.
class AstronomicalRefraction {
 public:
  explicit AstronomicalRefraction(const Air& air);
  // By how much the air lifts a body at this true zenith distance [rad].
  double lift_rad(double true_zenith_rad) const;

 private:
  double A_ = 0.0, B_ = 0.0;
};

}  // namespace ols::calibration
