#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/toml_config.h"
#include "tools/sim/scenario.h"

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
  try {
    parse_scenario(text, "s.toml", ".");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Scenario, ShippedOnesLoad) {
  for (const std::string name : {"fig7", "servo", "skyline", "faults", "small"}) {
    const Scenario s = load_scenario(std::string(OLS_SCENARIOS) + "/" + name + ".toml");
    EXPECT_EQ(s.name, name);
    EXPECT_EQ(s.stations.size(), name == "small" ? 2U : 4U);
    EXPECT_EQ(s.targets.size(), 1U);
  }
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
