#include "edge/mount/indi/telescope_axes.h"

#include <erfa.h>

#include <cmath>

#include "geometry/angles.h"

namespace ols::indi {
namespace {

struct Direction {
  double hour_angle_rad, dec_rad;
};

double side_of(double latitude_rad) { return latitude_rad < 0.0 ? -1.0 : 1.0; }

Direction direction_of(Axes axes, const PanTilt& angles, double latitude_rad) {
  const double side = side_of(latitude_rad);
  if (axes == Axes::kEquatorial) return {-side * angles.pan_rad, side * angles.tilt_rad};
  Direction direction{};
  eraAe2hd(-angles.pan_rad, angles.tilt_rad, latitude_rad, &direction.hour_angle_rad,
           &direction.dec_rad);
  return direction;
}

}  // namespace

double sidereal_time_rad(double utc_s, double longitude_rad) {
  constexpr double kUnixEpoch_jd = 2440587.5, kDay_s = 86400.0;
  const double day = utc_s / kDay_s;
  double tai1 = 0.0, tai2 = 0.0, tt1 = 0.0, tt2 = 0.0;
  eraUtctai(kUnixEpoch_jd, day, &tai1, &tai2);
  eraTaitt(tai1, tai2, &tt1, &tt2);
  return eraAnp(eraGst06a(kUnixEpoch_jd, day, tt1, tt2) + longitude_rad);
}

PanTilt axes_of(Axes axes, const Equatorial& seen, const Observer& observer, double utc_s,
                double middle_rad) {
  const double hour_angle_rad = sidereal_time_rad(utc_s, observer.longitude_rad) - seen.ra_rad;
  const double side = side_of(observer.latitude_rad);
  PanTilt angles{-side * hour_angle_rad, side * seen.dec_rad};
  if (axes == Axes::kAltAzimuth) {
    double azimuth_rad = 0.0;
    eraHd2ae(hour_angle_rad, seen.dec_rad, observer.latitude_rad, &azimuth_rad, &angles.tilt_rad);
    angles.pan_rad = -azimuth_rad;
  }
  angles.pan_rad = middle_rad + eraAnpm(angles.pan_rad - middle_rad);
  return angles;
}

Equatorial equatorial_of(Axes axes, const PanTilt& angles, const Observer& observer, double utc_s) {
  const Direction direction = direction_of(axes, angles, observer.latitude_rad);
  const double sidereal_rad = sidereal_time_rad(utc_s, observer.longitude_rad);
  return {eraAnp(sidereal_rad - direction.hour_angle_rad), direction.dec_rad};
}

TrackRate track_rate_of(Axes axes, const PanTilt& angles, const PanTilt& rate_rad_s,
                        const Observer& observer) {
  const double side = side_of(observer.latitude_rad);
  if (axes == Axes::kEquatorial) return {-side * rate_rad_s.pan_rad, side * rate_rad_s.tilt_rad};
  constexpr double kStep_s = 1e-3;
  const PanTilt later{angles.pan_rad + rate_rad_s.pan_rad * kStep_s,
                      angles.tilt_rad + rate_rad_s.tilt_rad * kStep_s};
  const Direction from = direction_of(axes, angles, observer.latitude_rad);
  const Direction to = direction_of(axes, later, observer.latitude_rad);
  return {eraAnpm(to.hour_angle_rad - from.hour_angle_rad) / kStep_s,
          (to.dec_rad - from.dec_rad) / kStep_s};
}

}  // namespace ols::indi
