// The doubt about the reference that one process persists, and what the next one does with it.
#include <gtest/gtest.h>

#include "tests/unit/edge/ptu/closed_loop.h"

namespace ols::ptu {
namespace {

constexpr mount::ReferenceDoubt kDoubted{false, false}, kBrokenOff{true, false};
constexpr mount::ReferenceDoubt kGearsLost{false, true}, kBoth{true, true};

TEST(PersistedDoubt, OutlivesTheStartUntilThePersonVouches) {
  for (const mount::ReferenceDoubt& doubt : {kDoubted, kBrokenOff}) {
    ClosedLoop loop(quick_driver(), quick_unit());
    loop.driver.restore_doubt(doubt);
    loop.run(8.0);
    EXPECT_EQ(loop.driver.state(), PtuState::kFault);
    EXPECT_EQ(loop.driver.reference(), mount::Reference::kDoubted);
    EXPECT_EQ(loop.driver.doubt_to_persist(), doubt);
    EXPECT_NE(loop.driver.last_error().find("before this start"), std::string::npos);
    EXPECT_TRUE(loop.driver.take_samples().empty());
    loop.driver.reference_ok();
    EXPECT_EQ(loop.driver.state(), PtuState::kReady);
    EXPECT_EQ(loop.driver.doubt_to_persist(), std::nullopt);
  }
}

TEST(PersistedDoubt, OfTheGearsNobodyVouches) {
  ClosedLoop loop(quick_driver(), quick_unit());
  loop.driver.restore_doubt(kGearsLost);
  loop.run(8.0);
  EXPECT_EQ(loop.driver.reference(), mount::Reference::kMissing);
  loop.driver.reference_ok();
  EXPECT_EQ(loop.driver.reference(), mount::Reference::kMissing);
  EXPECT_EQ(loop.driver.doubt_to_persist(), kGearsLost);
  loop.driver.home(loop.time_s);
  loop.run(60.0);
  EXPECT_EQ(loop.driver.state(), PtuState::kReady) << loop.driver.last_error();
  EXPECT_EQ(loop.driver.doubt_to_persist(), std::nullopt);
}

TEST(PersistedDoubt, ABrokenHomingIsNotBegunAgainByItself) {
  for (const mount::ReferenceDoubt& doubt : {kDoubted, kBrokenOff, kBoth}) {
    PtuConfig config = quick_driver();
    config.rehome = PtuRehome::kWhenUnreferenced;
    ClosedLoop loop(config, quick_unit());
    loop.driver.restore_doubt(doubt);
    loop.run(60.0);
    EXPECT_EQ(loop.driver.counters().homings, doubt == kDoubted ? 1u : 0u);
  }
}

// Whatever happens on the line, what is written down for the next start never becomes less.
TEST(PersistedDoubt, IsTheSameInEveryPhase) {
  for (const mount::ReferenceDoubt& doubt : {kDoubted, kBrokenOff, kGearsLost, kBoth}) {
    ClosedLoop loop(quick_driver(), quick_unit());
    loop.driver.restore_doubt(doubt);
    int others = 0;
    const auto count = [&] { others += loop.driver.doubt_to_persist() == doubt ? 0 : 1; };
    loop.cut = true;  // the unit does not answer
    loop.run(5.0, count);
    loop.cut = false;
    loop.run(10.0, count);
    loop.driver.restart(loop.time_s);  // the adapter was gone
    loop.run(5.0, count);
    EXPECT_EQ(others, 0) << to_word(doubt);
  }
}

// Its homing is broken off: it knows its gears no better for it.
TEST(PersistedDoubt, OfGearsIsKeptThroughABrokenHoming) {
  ClosedLoop loop(quick_driver(), quick_unit());
  loop.driver.restore_doubt(kGearsLost);
  loop.run(8.0);
  loop.driver.home(loop.time_s);
  loop.run(3.0);
  loop.driver.stop_homing(loop.time_s);
  EXPECT_EQ(loop.driver.doubt_to_persist(), kBoth);
  loop.run(60.0);
  EXPECT_EQ(loop.driver.doubt_to_persist(), kBoth);
  loop.driver.reference_ok();
  EXPECT_EQ(loop.driver.reference(), mount::Reference::kMissing);
}

TEST(PersistedDoubt, GearsLostAfterItWasVouchedForAreNoticed) {
  for (const bool vouched : {true, false}) {
    ClosedLoop loop(quick_driver(), quick_unit());
    loop.driver.restore_doubt(kDoubted);
    loop.run(8.0);
    if (vouched) loop.driver.reference_ok();
    loop.unit.power_cycle(loop.time_s);  // it is not configured to home itself
    loop.run(15.0);
    EXPECT_EQ(loop.driver.doubt_to_persist(), kGearsLost);
    loop.driver.reference_ok();
    EXPECT_EQ(loop.driver.reference(), mount::Reference::kMissing);
  }
}

TEST(PersistedDoubt, AVouchLetsTheNextLossBeHomedAgain) {
  PtuConfig config = quick_driver();
  config.rehome = PtuRehome::kWhenUnreferenced;
  ClosedLoop loop(config, quick_unit());
  loop.driver.restore_doubt(kDoubted);
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
}  // namespace ols::ptu
