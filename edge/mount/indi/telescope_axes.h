// Converts between right ascension and declination of date, as an INDI telescope reports them, and
// the angles of the telescope's axes. Uses the IAU's models (ERFA). Pure.
//
// Equatorial: the pan axis points to the celestial pole above the horizon; a positive pan turns
// left about it. In the northern hemisphere, pan is minus the hour angle, and tilt is the
// declination. In the southern one, pan is the hour angle, and tilt is minus the declination.
// Altazimuth: pan is minus the azimuth, and tilt is the elevation.
//
// A driver computes the right ascension from the axis's angle and a sidereal time. It takes this
// sidereal time from its own clock and longitude, with UT1 = UTC. The functions below recover the
// angle with the sidereal time that follows from the station's clock and the driver's longitude.
// The driver's clock must therefore agree with the station's clock: a difference of one second is
// an error of 15 arc seconds.
#pragma once

#include "geometry/kinematic_chain.h"

namespace ols::indi {

enum class Axes { kEquatorial, kAltAzimuth };

struct Equatorial {  // of date
  double ra_rad = 0.0, dec_rad = 0.0;
};
struct Observer {  // the telescope's place according to the driver
  double latitude_rad = 0.0, longitude_rad = 0.0;
};
// Rates of the telescope relative to the ground [rad/s]: INDI's track rates.
struct TrackRate {
  double hour_angle_rad_s = 0.0, dec_rad_s = 0.0;
};

// The apparent local sidereal time.
double sidereal_time_rad(double utc_s, double longitude_rad);

// The axes' angles; pan is within half a turn of `middle_rad`.
PanTilt axes_of(Axes axes, const Equatorial& seen, const Observer& observer, double utc_s,
                double middle_rad);
Equatorial equatorial_of(Axes axes, const PanTilt& angles, const Observer& observer, double utc_s);
TrackRate track_rate_of(Axes axes, const PanTilt& angles, const PanTilt& rate_rad_s,
                        const Observer& observer);

}  // namespace ols::indi
