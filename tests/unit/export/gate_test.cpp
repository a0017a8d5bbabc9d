#include "export/gate.h"

#include <gtest/gtest.h>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

TEST(ExportGate, LetsEachObjectPassAtItsRate) {
  Gate gate({.rate_hz = 2.0});
  int passed = 0, others = 0;
  for (int i = 0; i < 150; ++i) {  // 10 s at 15 Hz
    const auto after_us = static_cast<std::int64_t>(i * 1e6 / 15.0);
    passed += gate.pass(made_target(1, after_us)).has_value() ? 1 : 0;
    others += gate.pass(made_target(2, after_us)).has_value() ? 1 : 0;
  }
  EXPECT_GE(passed, 18);
  EXPECT_LE(passed, 22);
  EXPECT_EQ(passed, others);
}

TEST(ExportGate, AChangeOfStatePassesAtOnce) {
  Gate gate({.rate_hz = 1.0});
  EXPECT_TRUE(gate.pass(made_target()));
  EXPECT_FALSE(gate.pass(made_target(7, 100'000)));
  Target coasted = made_target(7, 200'000);
  coasted.state = TrackState::kCoasted;
  EXPECT_TRUE(gate.pass(coasted));
}

TEST(ExportGate, ATentativeTargetWaitsUntilItIsConfirmed) {
  Gate gate({}), open({.tentative = true});
  Target tentative = made_target();
  tentative.state = TrackState::kTentative;
  EXPECT_FALSE(gate.pass(tentative));
  EXPECT_TRUE(open.pass(tentative));
  EXPECT_TRUE(gate.pass(made_target(7, 1000)));
}

TEST(ExportGate, ATargetThatLeavesTheAreaEndsThereOnce) {
  Gate gate({.rate_hz = 100.0, .area_deg = {47.0, 13.0, 48.0, 14.0}});
  Target target = made_target();
  EXPECT_TRUE(gate.pass(target));
  target.place.latitude_deg = 48.1;
  target.utime_us += 1'000'000;
  const auto end = gate.pass(target);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->state, TrackState::kEnded);
  EXPECT_EQ(end->place.latitude_deg, made_target().place.latitude_deg);
  EXPECT_FALSE(gate.pass(target));
}

TEST(ExportGate, AnEndPassesOnlyForWhatWasTold) {
  Gate gate({});
  Target end = made_target();
  end.state = TrackState::kEnded;
  EXPECT_FALSE(gate.pass(end));
  EXPECT_TRUE(gate.pass(made_target()));
  EXPECT_TRUE(gate.pass(end));
  EXPECT_FALSE(gate.pass(end));
}

TEST(ExportGate, AnAreaMayLieOverTheDateLine) {
  Gate gate({.rate_hz = 100.0, .area_deg = {-90.0, 170.0, 90.0, -170.0}});
  Station station = made_station();
  EXPECT_FALSE(gate.passes(station));
  for (const double longitude_deg : {175.0, -175.0}) {
    station.place.longitude_deg = longitude_deg;
    station.utime_us += 1'000'000;
    EXPECT_TRUE(gate.passes(station)) << longitude_deg;
  }
}

TEST(ExportGate, KindsAreSwitchedOneByOne) {
  Gate quiet({.targets = false, .stations = false});
  EXPECT_FALSE(quiet.pass(made_target()));
  EXPECT_FALSE(quiet.passes(made_station()));
  EXPECT_FALSE(quiet.passes(made_line()));
  Gate lines({.lines = true});
  EXPECT_TRUE(lines.passes(made_line()));
  Line doubtful = made_line(1'000'000);
  doubtful.belief = 0.4;
  EXPECT_FALSE(lines.passes(doubtful));
}

TEST(Gate, AnIncidentPassesWithTargetsInItsAreaOnly) {
  EXPECT_TRUE(Gate({}).passes(made_incident()));
  EXPECT_FALSE(Gate({.targets = false}).passes(made_incident()));
  EXPECT_FALSE(Gate({.area_deg = {48, 13, 49, 14}}).passes(made_incident()));
}

}  // namespace
}  // namespace ols::exports
