#include "edge/mount/indi/telescope_axes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/angles.h"

namespace ols::indi {
namespace {

constexpr double kUtc_s = 1764415800.0;  // 2025-11-29T11:30:00Z
const Observer kObserver{radians(50.0), radians(10.0)};
const PanTilt kAngles{radians(-35.0), radians(40.0)};

// The Astronomical Almanac's formula for the mean time; both differ by the equation of the
// equinoxes, 1.2 s at most.
TEST(TelescopeAxes, SiderealTimeIsTheAlmanacs) {
  const double days = (kUtc_s - 946728000.0) / 86400.0;  // since J2000
  const double gmst_h = 18.697374558 + 24.06570982441908 * days;
  const double mean_rad = std::remainder(gmst_h * kPi / 12.0, 2.0 * kPi);
  const double apparent_rad = sidereal_time_rad(kUtc_s, 0.0);
  EXPECT_LT(std::abs(std::remainder(apparent_rad - mean_rad, 2.0 * kPi)),
            1.2 / 86400.0 * 2.0 * kPi);
}

TEST(TelescopeAxes, ThereAndBack) {
  for (const Axes axes : {Axes::kEquatorial, Axes::kAltAzimuth}) {
    for (const Observer& observer : {kObserver, Observer{radians(-34.0), radians(150.0)}}) {
      const Equatorial sky = equatorial_of(axes, kAngles, observer, kUtc_s);
      const PanTilt back = axes_of(axes, sky, observer, kUtc_s, 0.0);
      EXPECT_NEAR(back.pan_rad, kAngles.pan_rad, 1e-12);
      EXPECT_NEAR(back.tilt_rad, kAngles.tilt_rad, 1e-12);
    }
  }
}

// Both poles are above the horizon of their half; west of the meridian is left of it in the south.
TEST(TelescopeAxes, TheSouthLooksNorth) {
  const Observer south{radians(-34.0), radians(150.0)};
  const double sidereal_rad = sidereal_time_rad(kUtc_s, south.longitude_rad);
  const auto at = [&](double hour_angle_rad, double dec_rad) {
    return axes_of(Axes::kEquatorial, {sidereal_rad - hour_angle_rad, dec_rad}, south, kUtc_s, 0.0);
  };
  EXPECT_NEAR(at(0.1, 0.0).pan_rad, 0.1, 1e-9);
  EXPECT_NEAR(at(0.0, radians(-90.0)).tilt_rad, radians(90.0), 1e-12);
}

TEST(TelescopeAxes, PanIsWithinHalfATurnOfTheMiddle) {
  const Equatorial sky = equatorial_of(Axes::kEquatorial, kAngles, kObserver, kUtc_s);
  EXPECT_NEAR(axes_of(Axes::kEquatorial, sky, kObserver, kUtc_s, radians(190.0)).pan_rad,
              kAngles.pan_rad + 2.0 * kPi, 1e-12);
}

// In the meridian, a telescope that points south turns left in both ways of counting.
TEST(TelescopeAxes, TurnsLeftWithAPositivePan) {
  const double sidereal_rad = sidereal_time_rad(kUtc_s, kObserver.longitude_rad);
  const Equatorial south{sidereal_rad, 0.0}, east{sidereal_rad + 0.1, 0.0};
  for (const Axes axes : {Axes::kEquatorial, Axes::kAltAzimuth}) {
    const double middle_rad = axes == Axes::kEquatorial ? 0.0 : -kPi;
    EXPECT_GT(axes_of(axes, east, kObserver, kUtc_s, middle_rad).pan_rad,
              axes_of(axes, south, kObserver, kUtc_s, middle_rad).pan_rad);
  }
}

// A telescope that tracks at these rates for a second is where the rates of its axes lead.
TEST(TelescopeAxes, TrackRatesLeadAlong) {
  const PanTilt rate{radians(0.5), radians(-0.2)};
  for (const Axes axes : {Axes::kEquatorial, Axes::kAltAzimuth}) {
    const TrackRate track = track_rate_of(axes, kAngles, rate, kObserver);
    const Equatorial from = equatorial_of(axes, kAngles, kObserver, kUtc_s);
    const double turned_rad = sidereal_time_rad(kUtc_s + 0.1, kObserver.longitude_rad) -
                              sidereal_time_rad(kUtc_s, kObserver.longitude_rad);
    const Equatorial to{from.ra_rad + turned_rad - 0.1 * track.hour_angle_rad_s,
                        from.dec_rad + 0.1 * track.dec_rad_s};
    const PanTilt there = axes_of(axes, to, kObserver, kUtc_s + 0.1, 0.0);
    EXPECT_NEAR(there.pan_rad, kAngles.pan_rad + 0.1 * rate.pan_rad, 1e-6);
    EXPECT_NEAR(there.tilt_rad, kAngles.tilt_rad + 0.1 * rate.tilt_rad, 1e-6);
  }
}

}  // namespace
}  // namespace ols::indi
