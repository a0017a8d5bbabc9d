// Converts between the right ascension and declination of date that an INDI telescope reports and
// the angles of its axes, with the IAU's models (ERFA). Pure.
//
// Equatorial: the pan axis points to the celestial pole above the horizon; a positive pan turns
// left about it. In the north pan is minus the hour angle and tilt the declination, in the south
// pan is the hour angle and tilt minus the declination. Altazimuth: pan is minus the azimuth, tilt
// is the elevation.
//
// The driver computes right ascension from its axis, its clock and its longitude, with UT1 = UTC.
// The same sidereal time gives the angle of the axis again. It is computed with the driver's
// longitude and the station's clock. The driver's clock must agree with that clock: a difference of
// one second is an error of 15 arc seconds.
#pragma once

#include "geometry/kinematic_chain.h"

namespace ols::indi {

enum class Axes { kEquatorial, kAltAzimuth };

struct Equatorial {  // of date
  double ra_rad = 0.0, dec_rad = 0.0;
};
struct Observer {  // the place that the driver uses
  double latitude_rad = 0.0, longitude_rad = 0.0;
};
// Rates of the telescope relative to the ground [rad/s]: INDI's track rates.
struct TrackRate {
  double hour_angle_rad_s = 0.0, dec_rad_s = 0.0;
};

// Apparent local sidereal time.
double sidereal_time_rad(double utc_s, double longitude_rad);

// Pan within half a turn of `middle_rad`.
PanTilt axes_of(Axes axes, const Equatorial& seen, const Observer& observer, double utc_s,
                double middle_rad);
Equatorial equatorial_of(Axes axes, const PanTilt& angles, const Observer& observer, double utc_s);
TrackRate track_rate_of(Axes axes, const PanTilt& angles, const PanTilt& rate_rad_s,
                        const Observer& observer);

}  // namespace ols::indi
