// What a process leaves to the next one about a unit's counts, and what that one makes of it.
#include <gtest/gtest.h>

#include "tests/unit/edge/ptu/closed_loop.h"

namespace ols {
namespace {

TEST(DoubtOfBefore, OutlivesTheStartUntilThePersonVouches) {
  for (const PtuLegacy legacy : {PtuLegacy::kDoubt, PtuLegacy::kBrokenHoming}) {
    ClosedLoop loop(quick_driver(), quick_unit());
    loop.driver.inherit(legacy);
    loop.run(8.0);
    EXPECT_EQ(loop.driver.state(), PtuState::kFault);
    EXPECT_EQ(loop.driver.reference(), PtuReference::kDoubted);
    EXPECT_EQ(loop.driver.legacy(), legacy);
    EXPECT_NE(loop.driver.last_error().find("before this start"), std::string::npos);
    EXPECT_TRUE(loop.driver.take_samples().empty());
    loop.driver.reference_ok();
    EXPECT_EQ(loop.driver.state(), PtuState::kReady);
    EXPECT_EQ(loop.driver.legacy(), PtuLegacy::kNone);
  }
}

TEST(DoubtOfBefore, OfTheGearsNobodyVouches) {
  ClosedLoop loop(quick_driver(), quick_unit());
  loop.driver.inherit(PtuLegacy::kGearsLost);
  loop.run(8.0);
  EXPECT_EQ(loop.driver.reference(), PtuReference::kMissing);
  loop.driver.reference_ok();
  EXPECT_EQ(loop.driver.reference(), PtuReference::kMissing);
  EXPECT_EQ(loop.driver.legacy(), PtuLegacy::kGearsLost);
  loop.driver.home(loop.time_s);
  loop.run(60.0);
  EXPECT_EQ(loop.driver.state(), PtuState::kReady) << loop.driver.last_error();
  EXPECT_EQ(loop.driver.legacy(), PtuLegacy::kNone);
}

TEST(DoubtOfBefore, ABrokenHomingIsNotBegunAgainByItself) {
  for (const PtuLegacy legacy :
       {PtuLegacy::kDoubt, PtuLegacy::kBrokenHoming, PtuLegacy::kBrokenHomingGearsLost}) {
    PtuConfig config = quick_driver();
    config.rehome = PtuRehome::kWhenUnreferenced;
    ClosedLoop loop(config, quick_unit());
    loop.driver.inherit(legacy);
    loop.run(60.0);
    EXPECT_EQ(loop.driver.counters().homings, legacy == PtuLegacy::kDoubt ? 1u : 0u);
  }
}

// Whatever happens on the line, what is written down for the next start never becomes less.
TEST(DoubtOfBefore, IsTheSameInEveryPhase) {
  for (const PtuLegacy legacy : {PtuLegacy::kDoubt, PtuLegacy::kBrokenHoming, PtuLegacy::kGearsLost,
                                 PtuLegacy::kBrokenHomingGearsLost}) {
    ClosedLoop loop(quick_driver(), quick_unit());
    loop.driver.inherit(legacy);
    int others = 0;
    const auto count = [&] { others += loop.driver.legacy() == legacy ? 0 : 1; };
    loop.cut = true;  // nobody answers
    loop.run(5.0, count);
    loop.cut = false;
    loop.run(10.0, count);
    loop.driver.restart(loop.time_s);  // the adapter was gone
    loop.run(5.0, count);
    EXPECT_EQ(others, 0) << static_cast<int>(legacy);
  }
}

// Its homing is broken off: it knows its gears no better for it.
TEST(DoubtOfBefore, OfGearsIsKeptThroughABrokenHoming) {
  ClosedLoop loop(quick_driver(), quick_unit());
  loop.driver.inherit(PtuLegacy::kGearsLost);
  loop.run(8.0);
  loop.driver.home(loop.time_s);
  loop.run(3.0);
  loop.driver.stop_homing(loop.time_s);
  EXPECT_EQ(loop.driver.legacy(), PtuLegacy::kBrokenHomingGearsLost);
  loop.run(60.0);
  EXPECT_EQ(loop.driver.legacy(), PtuLegacy::kBrokenHomingGearsLost);
  loop.driver.reference_ok();
  EXPECT_EQ(loop.driver.reference(), PtuReference::kMissing);
}

TEST(DoubtOfBefore, GearsLostAfterItWasVouchedForAreNoticed) {
  for (const bool vouched : {true, false}) {
    ClosedLoop loop(quick_driver(), quick_unit());
    loop.driver.inherit(PtuLegacy::kDoubt);
    loop.run(8.0);
    if (vouched) loop.driver.reference_ok();
    loop.unit.power_cycle(loop.time_s);  // it is not configured to home itself
    loop.run(15.0);
    EXPECT_EQ(loop.driver.legacy(), PtuLegacy::kGearsLost);
    loop.driver.reference_ok();
    EXPECT_EQ(loop.driver.reference(), PtuReference::kMissing);
  }
}

TEST(DoubtOfBefore, AVouchLetsTheNextLossBeHomedAgain) {
  PtuConfig config = quick_driver();
  config.rehome = PtuRehome::kWhenUnreferenced;
  ClosedLoop loop(config, quick_unit());
  loop.driver.inherit(PtuLegacy::kDoubt);
  loop.run(2.0);
  loop.driver.stop_homing(loop.time_s);
  loop.run(60.0);  // a unit may sweep on
  loop.driver.reference_ok();
  ASSERT_EQ(loop.driver.state(), PtuState::kReady) << loop.driver.last_error();
  const auto before = loop.driver.counters().homings;
  loop.driver.receive("!P", loop.time_s);  // a limit hit
  loop.run(60.0);
  EXPECT_EQ(loop.driver.counters().homings, before + 1);
}

}  // namespace
}  // namespace ols
