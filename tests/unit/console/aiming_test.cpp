#include "console/aiming.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"
#include "geometry/sight.h"

namespace ols::console {
namespace {

const Geodetic kStation{radians(49.225), radians(16.594), 300.0};

// A unit as it is mounted: tilted, its zeros anywhere, its camera askew, counting to the right.
StationGeometry real_station() {
  StationGeometry station;
  station.position = kStation;
  station.chain.heading_rad = radians(40.0);
  station.chain.tilt_x_rad = radians(1.5);
  station.chain.tilt_y_rad = radians(-1.0);
  station.chain.pan_sign = -1;
  station.chain.pan_zero_rad = radians(12.0);
  station.chain.tilt_zero_rad = radians(-3.0);
  station.chain.mount_z_rad = radians(0.5);
  return station;
}

Json array(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json status(const StationGeometry& station, const PanTilt& now) {
  const AzimuthElevation axis = optical_axis(station, now);
  return {{"heading_deg", degrees(station.chain.heading_rad)},
          {"tilt_x_deg", degrees(station.chain.tilt_x_rad)},
          {"tilt_y_deg", degrees(station.chain.tilt_y_rad)},
          {"pan_sign", station.chain.pan_sign},
          {"tilt_sign", station.chain.tilt_sign},
          {"pan_deg", degrees(now.pan_rad)},
          {"tilt_deg", degrees(now.tilt_rad)},
          {"azimuth_deg", degrees(axis.azimuth_rad)},
          {"elevation_deg", degrees(axis.elevation_rad)},
          {"camera_ecef_m", array(camera_centre_ecef(station, now))}};
}

TEST(Aiming, ThePlaceComesIntoTheMiddleOfThePicture) {
  const StationGeometry station = real_station();
  const Geodetic place{radians(49.2265), radians(16.597), 380.0};
  const auto aimed = aim_at_place(status(station, {radians(5.0), radians(4.0)}), place);
  const auto exact = aim_at(station, ecef_from_geodetic(place));
  ASSERT_TRUE(aimed && exact);
  // A small part of a picture, which is 5.5 degrees wide.
  EXPECT_NEAR(degrees(wrap_pi(aimed->pan_rad - exact->pan_rad)), 0.0, 0.2);
  EXPECT_NEAR(degrees(aimed->tilt_rad - exact->tilt_rad), 0.0, 0.2);
}

TEST(Aiming, TheOtherWayRoundWhereTheTravelEnds) {
  const StationGeometry station = real_station();
  const Geodetic behind{radians(49.22), radians(16.59), 350.0};
  Json fields = status(station, {radians(150.0), radians(4.0)});
  const auto anywhere = aim_at_place(fields, behind);
  ASSERT_TRUE(anywhere);
  fields["pan_limits_deg"] = {degrees(anywhere->pan_rad) - 370.0, degrees(anywhere->pan_rad) - 5.0};
  const auto round = aim_at_place(fields, behind);
  ASSERT_TRUE(round);
  EXPECT_NEAR(round->pan_rad, anywhere->pan_rad - 2 * kPi, 1e-9);
  fields["pan_limits_deg"] = {degrees(anywhere->pan_rad) + 5.0, degrees(anywhere->pan_rad) + 6.0};
  EXPECT_FALSE(aim_at_place(fields, behind)) << "out of its travel";
}

TEST(Aiming, NowhereWhileItDoesNotKnowWhereItLooks) {
  const Geodetic place{radians(49.2265), radians(16.597), 380.0};
  for (const char* field : {"heading_deg", "pan_deg", "azimuth_deg", "camera_ecef_m"}) {
    Json fields = status(real_station(), {0.0, 0.0});
    fields[field] = nullptr;
    EXPECT_FALSE(aim_at_place(fields, place)) << field;
    fields.erase(field);
    EXPECT_FALSE(aim_at_place(fields, place)) << field;
  }
}

}  // namespace
}  // namespace ols::console
