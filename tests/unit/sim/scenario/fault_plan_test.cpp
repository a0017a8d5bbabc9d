#include "sim/scenario/fault_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "base/config/toml_config.h"
#include "sim/scenario/scenario.h"
#include "tests/unit/error_text.h"

namespace ols::sim {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(FaultPlan, AFaultHoldsForItsTimeAtItsStation) {
  FaultPlan plan;
  plan.add({"ptu-line-cut", "alfa", 10.0, 5.0});
  EXPECT_FALSE(plan.at("alfa", 9.999).ptu.line_cut);
  EXPECT_TRUE(plan.at("alfa", 10.0).ptu.line_cut);
  EXPECT_TRUE(plan.at("alfa", 14.999).ptu.line_cut);
  EXPECT_EQ(plan.at("alfa", 15.0), StationFaults{});
  EXPECT_EQ(plan.at("bravo", 12.0), StationFaults{});
}

TEST(FaultPlan, WithoutAStationItHoldsAtAll) {
  FaultPlan plan;
  plan.add({"camera-gone", "", 1.0, kInfinity});
  EXPECT_TRUE(plan.at("alfa", 1e6).camera.gone);
  EXPECT_TRUE(plan.at("bravo", 1e6).camera.gone);
}

TEST(FaultPlan, DifferentKindsAddUp) {
  FaultPlan plan;
  plan.add({"ptu-garbled", "alfa", 0.0, 10.0, 0.2});
  plan.add({"ptu-echo-on", "alfa", 5.0, 10.0});
  plan.add({"gnss-jump", "alfa", 0.0, 10.0});
  const StationFaults now = plan.at("alfa", 7.0);
  EXPECT_EQ(now.ptu.garble_share, 0.2);
  EXPECT_TRUE(now.ptu.echo_on);
  EXPECT_EQ(now.gnss.jump_m, 100.0);
}

TEST(FaultPlan, OfOneKindTheOneThatBeganLastCounts) {
  FaultPlan plan;
  plan.add({"ptu-garbled", "alfa", 4.0, 2.0, 0.5});  // added first, begins last
  plan.add({"ptu-garbled", "alfa", 0.0, 10.0, 0.1});
  EXPECT_EQ(plan.at("alfa", 1.0).ptu.garble_share, 0.1);
  EXPECT_EQ(plan.at("alfa", 5.0).ptu.garble_share, 0.5);
  EXPECT_EQ(plan.at("alfa", 7.0).ptu.garble_share, 0.1);
}

TEST(FaultPlan, EveryKindChangesSomethingAndNoTwoTheSame) {
  std::vector<StationFaults> seen{StationFaults{}};
  for (const std::string& kind : fault_kinds()) {
    FaultPlan plan;
    plan.add({kind, "alfa", 0.0, 1.0});
    const StationFaults now = plan.at("alfa", 0.5);
    for (const StationFaults& other : seen) EXPECT_FALSE(now == other) << kind;
    seen.push_back(now);
  }
}

TEST(FaultPlan, ACommandHoldsFromNowOn) {
  FaultPlan plan;
  plan.command({"gnss-no-fix", "alfa", 0.0, 3.0}, 100.0);
  EXPECT_FALSE(plan.at("alfa", 99.9).gnss.no_fix);
  EXPECT_TRUE(plan.at("alfa", 102.9).gnss.no_fix);
  EXPECT_FALSE(plan.at("alfa", 103.0).gnss.no_fix);
}

TEST(FaultPlan, ACommandOfDurationZeroEndsItsKindOnly) {
  FaultPlan plan;
  plan.command({"gnss-no-fix", "alfa", 0.0, kInfinity}, 1.0);
  plan.command({"gnss-no-fix", "bravo", 0.0, kInfinity}, 1.0);
  plan.command({"camera-gone", "alfa", 0.0, kInfinity}, 1.0);
  plan.command({"gnss-no-fix", "alfa", 0.0, 0.0}, 2.0);
  EXPECT_FALSE(plan.at("alfa", 3.0).gnss.no_fix);
  EXPECT_TRUE(plan.at("alfa", 3.0).camera.gone);
  EXPECT_TRUE(plan.at("bravo", 3.0).gnss.no_fix);
  plan.command({"gnss-no-fix", "", 0.0, 0.0}, 4.0);
  EXPECT_FALSE(plan.at("bravo", 5.0).gnss.no_fix);
  plan.command({"all", "", 0.0, 0.0}, 6.0);
  EXPECT_EQ(plan.at("alfa", 7.0), StationFaults{});
  EXPECT_THROW(plan.command({"all", "", 0.0, 5.0}, 8.0), std::invalid_argument);
}

TEST(FaultPlan, RefusesWhatCannotBeHad) {
  FaultPlan plan;
  EXPECT_THROW(plan.add({"ptu-on-fire", "alfa", 0.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(plan.add({"ptu-garbled", "alfa", 0.0, 1.0, 1.5}), std::invalid_argument);
  EXPECT_THROW(plan.add({"camera-gone", "alfa", 0.0, 1.0, 3.0}), std::invalid_argument);
  EXPECT_THROW(plan.add({"camera-gone", "alfa", -1.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(plan.add({"camera-gone", "alfa", std::nan(""), 1.0}), std::invalid_argument);
  EXPECT_THROW(plan.command({"camera-gone", "alfa", 0.0, -1.0}, 5.0), std::invalid_argument);
  EXPECT_THROW(plan.command({"camera-gone", "alfa", 0.0, std::nan("")}, 5.0),
               std::invalid_argument);
  EXPECT_THROW(plan.command({"ptu-on-fire", "alfa", 0.0, 0.0}, 5.0), std::invalid_argument);
  EXPECT_EQ(plan.at("alfa", 0.5), StationFaults{});
}

const std::string kScenario =
    "name = \"small\"\n"                 // 1
    "[site]\n"                           // 2
    "latitude_deg = 49\n"                // 3
    "longitude_deg = 16\n"               // 4
    "height_m = 300\n"                   // 5
    "[[station]]\n"                      // 6
    "id = \"alfa\"\n"                    // 7
    "camera_address = \"127.0.0.11\"\n"  // 8
    "[[target]]\n"                       // 9
    "[target.trajectory]\n"              // 10
    "kind = \"line\"\n"                  // 11
    "[[fault]]\n";                       // 12

std::string error_of(const std::string& fault) {
  return error_text<ConfigError>([&] { parse_scenario(kScenario + fault, "s.toml", "."); });
}

TEST(FaultPlan, AScenarioSchedulesFaults) {
  const Scenario s = parse_scenario(
      kScenario +
          "kind = \"ptu-garbled\"\nstation = \"alfa\"\nat_s = 10\nfor_s = 5\nvalue = 0.3\n"
          "[[fault]]\nkind = \"camera-gone\"\nat_s = 20\n",
      "s.toml", ".");
  ASSERT_EQ(s.faults.size(), 2U);
  FaultPlan plan;
  for (const Fault& fault : s.faults) plan.add(fault);
  EXPECT_EQ(plan.at("alfa", 12.0).ptu.garble_share, 0.3);
  EXPECT_TRUE(plan.at("alfa", 1e6).camera.gone);  // without for_s: to the end
}

TEST(FaultPlan, AScenariosErrorsNameFileLineAndKey) {
  EXPECT_THAT(error_of("kind = \"ptu-on-fire\"\nat_s = 1\n"), StartsWith("s.toml:13: "));
  EXPECT_THAT(error_of("kind = \"ptu-on-fire\"\nat_s = 1\n"), HasSubstr("ptu-on-fire"));
  EXPECT_THAT(error_of("kind = \"camera-gone\"\n"), HasSubstr("at_s"));
  EXPECT_THAT(error_of("kind = \"camera-gone\"\nat_s = 1\nfor_s = 0\n"), StartsWith("s.toml:15: "));
  EXPECT_THAT(error_of("kind = \"camera-gone\"\nat_s = 1\nstation = \"zulu\"\n"),
              StartsWith("s.toml:15: "));
  EXPECT_THAT(error_of("kind = \"ptu-garbled\"\nat_s = 1\nvalue = 2\n"), StartsWith("s.toml:15: "));
  EXPECT_THAT(error_of("kind = \"camera-gone\"\nat_s = 1\nfor = 3\n"), HasSubstr("for"));
}

}  // namespace
}  // namespace ols::sim
