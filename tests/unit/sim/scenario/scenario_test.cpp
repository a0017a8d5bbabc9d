#include "sim/scenario/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <stdexcept>

#include "base/config/toml_config.h"
#include "sim/world/world.h"
#include "tests/unit/error_text.h"

namespace ols::sim {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kSmall =
    "name = \"small\"\n"                 // 1
    "[site]\n"                           // 2
    "latitude_deg = 49\n"                // 3
    "longitude_deg = 16\n"               // 4
    "height_m = 300\n"                   // 5
    "[[station]]\n"                      // 6
    "id = \"a\"\n"                       // 7
    "camera_address = \"127.0.0.11\"\n"  // 8
    "[[target]]\n"                       // 9
    "[target.trajectory]\n"              // 10
    "kind = \"line\"\n";                 // 11

std::string error_of(const std::string& text) {
  return error_text<ConfigError>([&] { parse_scenario(text, "s.toml", "."); });
}

TEST(Scenario, ShippedOnesLoad) {
  const std::map<std::string, std::size_t> stations{{"fig7", 4},    {"overview", 5}, {"servo", 4},
                                                    {"skyline", 4}, {"faults", 4},   {"small", 2}};
  for (const auto& [name, count] : stations) {
    const Scenario s = load_scenario(std::string(OLS_SCENARIOS) + "/" + name + ".toml");
    EXPECT_EQ(s.name, name);
    EXPECT_EQ(s.stations.size(), count);
    EXPECT_EQ(s.targets.size(), 1U);
  }
}

TEST(Scenario, TheUnattendedOneHasThreeKindsOfTargets) {
  const Scenario s = load_scenario(std::string(OLS_SCENARIOS) + "/unattended.toml");
  EXPECT_TRUE(s.detector_on);
  std::vector<FlyerShape> shapes;
  for (const TargetScenario& target : s.targets) shapes.push_back(target.shape);
  EXPECT_EQ(shapes, (std::vector{FlyerShape::kDrone, FlyerShape::kBird, FlyerShape::kAircraft}));
  for (const StationScenario& station : s.stations) EXPECT_TRUE(station.watch) << station.id;
}

TEST(Scenario, ThePapersExperimentsLoad) {
  Scenario table1 = load_scenario(std::string(OLS_SCENARIOS) + "/table1.toml");
  EXPECT_EQ(table1.targets.size(), 9U);
  // As in the paper's Table 1, from the first station.
  keep_target(table1, "mast");
  ASSERT_EQ(table1.targets.size(), 1U);
  const Eigen::Vector3d mast = table1.targets[0].trajectory->at(3.0).p_enu;
  EXPECT_NEAR((mast - table1.stations[0].p_enu).head<2>().norm(), 1379.67, 0.02);
  EXPECT_NEAR((table1.stations[1].p_enu - table1.stations[0].p_enu).norm(), 30.0, 1e-9);
  EXPECT_THROW(keep_target(table1, "pillar1"), std::invalid_argument);
  const Scenario walk = load_scenario(std::string(OLS_SCENARIOS) + "/walk.toml");
  for (double t = 3.0; t < 123.0; t += 0.5) {
    const Motion m = walk.targets[0].trajectory->at(t);
    EXPECT_GT(m.p_enu.head<2>().norm(), 49.0);
    EXPECT_LT(m.p_enu.head<2>().norm(), 205.0);
    EXPECT_LT(m.v_enu.norm(), 2.5);
  }
}

TEST(Scenario, LandmarkInUtmStandsWhereTheGridHasIt) {
  // On the central meridian of zone 33, where grid north is true north.
  std::string text = kSmall;
  text.replace(text.find("longitude_deg = 16"), 18, "longitude_deg = 15");
  text.replace(text.find("\"line\""), 6,
               "\"utm\"\nzone = 33\neasting_m = 500100\nnorthing_m = 5427437.21\nheight_m = 310");
  const Scenario s = parse_scenario(text, "s.toml", ".");
  const Motion m = s.targets[0].trajectory->at(7.0);
  EXPECT_NEAR(m.p_enu.x(), 100.0 / 0.9996, 0.02);
  EXPECT_NEAR(m.p_enu.z(), 10.0, 1e-2);
  EXPECT_EQ(m.v_enu.norm(), 0.0);
  text.replace(text.find("zone = 33"), 9, "zone = 0");
  EXPECT_THAT(error_of(text), HasSubstr("UTM zone"));
}

const std::string kLandmark =
    "[[stationing.landmark]]\nid = \"church\"\nzone = 33\neasting_m = 615618.03\n"
    "northing_m = 5455309.69\nheight_m = 274.2\nsd_m = 0.14\n";

TEST(Scenario, LandmarksOfTheStationingAreInUtm) {
  const Scenario s =
      parse_scenario(kSmall + "[stationing]\nby = \"landmarks\"\n" + kLandmark, "s.toml", ".");
  EXPECT_EQ(s.stationing.by, StationingBy::kLandmarks);
  ASSERT_EQ(s.stationing.landmarks.size(), 1U);
  const Geodetic place = geodetic_from_ecef(s.stationing.landmarks[0].p_ecef);
  EXPECT_NEAR(degrees(place.longitude_rad), 16.5884, 1e-4);
  EXPECT_NEAR(place.height_m, 274.2, 1e-6);
  EXPECT_EQ(s.stationing.landmarks[0].sd_m, 0.14);
}

TEST(Scenario, StationingNeedsWhatItSights) {
  EXPECT_THAT(error_of(kSmall + "[stationing]\nby = \"landmarks\"\n"), HasSubstr("no landmarks"));
  EXPECT_THAT(error_of(kSmall + "[stationing]\nby = \"compass\"\n"),
              HasSubstr("drawn, each-other, landmarks"));
  std::string text = kSmall + "[stationing]\n" + kLandmark;
  text.replace(text.find("zone = 33"), 9, "zone = 99");
  EXPECT_THAT(error_of(text), HasSubstr("zone"));
}

TEST(Scenario, TargetsHaveIdsOfTheirOwn) {
  const std::string another = "[[target]]\nid = \"1\"\n[target.trajectory]\nkind = \"line\"\n";
  EXPECT_THAT(error_of(kSmall + another), HasSubstr("is used by two targets"));
}

TEST(Scenario, AnErrorIsSwitchedOffByItsName) {
  Errors errors;
  switch_off(errors, "heading");
  switch_off(errors, "ptu_reply");
  EXPECT_FALSE(errors.heading.on || errors.ptu_reply.on);
  EXPECT_TRUE(errors.tilt.on && errors.mounting.on && errors.clock.on);
  EXPECT_THROW(switch_off(errors, "hading"), std::invalid_argument);
}

TEST(Scenario, Fig7HasTheSpeedsAndDistancesOfADrone) {
  const Scenario s = load_scenario(std::string(OLS_SCENARIOS) + "/fig7.toml");
  for (double t = 0; t < 600; t += 0.5) {
    const Motion m = s.targets[0].trajectory->at(t);
    EXPECT_GT(m.v_enu.norm(), 6.0);
    EXPECT_LT(m.v_enu.norm(), 16.0);
    EXPECT_GT(m.p_enu.z(), 40.0);
    EXPECT_LT(m.p_enu.z(), 120.0);
    for (const StationScenario& station : s.stations) {
      EXPECT_GT((m.p_enu - station.p_enu).norm(), 200.0);
      EXPECT_LT((m.p_enu - station.p_enu).norm(), 600.0);
    }
  }
}

TEST(Scenario, ServoDemandsTenDegreesASecond) {
  const Scenario s = load_scenario(std::string(OLS_SCENARIOS) + "/servo.toml");
  double fastest = 0.0;
  for (double t = 0; t < 120; t += 0.02) {
    const Motion m = s.targets[0].trajectory->at(t);
    for (const StationScenario& station : s.stations) {
      const Eigen::Vector3d p = m.p_enu - station.p_enu;
      fastest = std::max(fastest, p.cross(m.v_enu).norm() / p.squaredNorm());
    }
  }
  EXPECT_NEAR(degrees(fastest), 10.0, 0.3);
}

TEST(Scenario, ErrorsNameFileLineAndKey) {
  EXPECT_EQ(error_of(kSmall), "");
  EXPECT_THAT(error_of(kSmall + "hight = 3\n"), StartsWith("s.toml:12: "));
  EXPECT_THAT(error_of(kSmall + "hight = 3\n"), HasSubstr("hight"));
  const std::string far = kSmall + "start_enu_m = [1, 2, 3e9]\n";
  EXPECT_THAT(error_of(far), StartsWith("s.toml:12: "));
  EXPECT_THAT(error_of(far), HasSubstr("start_enu_m"));
  EXPECT_THAT(error_of(kSmall + "[errors.heading]\nsd_deg = -1\n"), StartsWith("s.toml:13: "));
  EXPECT_THAT(error_of(kSmall + "[errors.heading]\non = 1\n"), HasSubstr("on"));
}

TEST(Scenario, AStationMayHaveALensOfItsOwn) {
  const std::string other = kSmall + "[[station]]\nid = \"b\"\ncamera_address = \"127.0.0.12\"\n";
  const std::string wide = "focal_length_mm = 3.0\nlens = \"fisheye\"\n";
  const std::string standing = "fixed_pan_tilt_deg = [0, 12]\n";
  const Scenario s = parse_scenario(other + wide + standing, "s.toml", ".");
  EXPECT_NEAR(s.camera_of(s.stations[0]).fx_px, 50e3 / 3.75, 1e-9);
  const CameraIntrinsics& own = World(s, 1).stations()[1].nominal.camera;
  EXPECT_NEAR(own.fx_px, 800.0, 1e-9);
  EXPECT_EQ(own.model, LensModel::kFisheye);
  EXPECT_EQ(own.width_px, s.camera.width_px);
  EXPECT_THAT(error_of(other + wide), HasSubstr("fixed_pan_tilt_deg"));
  EXPECT_THAT(error_of(other + "lens = \"fisheye\"\n" + standing), HasSubstr("s.toml:15: "));
  const std::string zoom = "kind = \"overview\"\nzoom_mm = [10, 100]\nfocal_length_mm = 3.0\n";
  EXPECT_THAT(error_of(other + zoom), HasSubstr("zoom_mm"));
}

TEST(Scenario, RefusesTwoStationsOfOneName) {
  const std::string twice = kSmall + "[[station]]\nid = \"a\"\ncamera_address = \"127.0.0.12\"\n";
  EXPECT_THAT(error_of(twice), HasSubstr("two stations"));
}

TEST(Scenario, NeedsAStationAndATarget) {
  const std::string site = kSmall.substr(0, kSmall.find("[[station]]"));
  EXPECT_THAT(error_of(site), HasSubstr("station"));
  EXPECT_THAT(error_of(kSmall.substr(0, kSmall.find("[[target]]"))), HasSubstr("target"));
}

TEST(Scenario, MissingFileIsNamed) {
  EXPECT_THROW(load_scenario("nowhere/none.toml"), ConfigError);
  EXPECT_THAT(
      error_of(kSmall.substr(0, kSmall.find("kind")) + "kind = \"file\"\nfile = \"none.csv\"\n"),
      HasSubstr("none.csv"));
}

}  // namespace
}  // namespace ols::sim
