#include "edge/command_turn.h"

#include "station_fixture.h"

namespace ols::station {
namespace {

class CommandTurnTest : public test::StationTest {
 protected:
  CommandTurnTest() { run_until(100.5); }
  void designate(double x_px) { turn_.designate({std::nullopt, {x_px, 469, 20, 20}}); }
  CommandTurn turn_{station_};
};

TEST_F(CommandTurnTest, CarriesOutTheNewestDesignationAtItsEnd) {
  designate(100);
  designate(200);
  EXPECT_EQ(script_.initialised, 0);
  EXPECT_EQ(turn_.end(now_), Refusal::kNone);
  EXPECT_EQ(script_.initialised, 1);
  EXPECT_EQ(script_.first_box.x, 200.0);
  EXPECT_EQ(turn_.superseded(), 1U);
  turn_.end(now_);
  EXPECT_EQ(script_.initialised, 1) << "once";
}

TEST_F(CommandTurnTest, ADesignationComesBeforeTheNextCommandButTwoATurnAreTheMost) {
  designate(100);
  turn_.before_other_command(now_);
  EXPECT_EQ(script_.first_box.x, 100.0);
  designate(200);
  turn_.before_other_command(now_);
  EXPECT_EQ(script_.initialised, 1);
  designate(300);
  turn_.end(now_);
  EXPECT_EQ(script_.initialised, 2);
  EXPECT_EQ(script_.first_box.x, 300.0);
  EXPECT_EQ(turn_.superseded(), 1U);
}

TEST_F(CommandTurnTest, AStopWaitsForNoDesignationAndEndsTheTurn) {
  designate(100);
  turn_.stop();
  EXPECT_EQ(turn_.end(now_), Refusal::kNone);
  EXPECT_EQ(script_.initialised, 0);
  EXPECT_EQ(turn_.superseded(), 1U);
  EXPECT_EQ(station_.state(), StationState::kStopped);
  now_ += Station::kStopHold_s;
  ASSERT_EQ(station_.release(now_), Refusal::kNone);
  turn_.end(now_);
  EXPECT_EQ(station_.state(), StationState::kIdle) << "one stop stops once";
}

TEST_F(CommandTurnTest, TellsWhyADesignationWasRefused) {
  script_.accept = false;
  designate(100);
  EXPECT_EQ(turn_.end(now_), Refusal::kBox);
}

}  // namespace
}  // namespace ols::station
