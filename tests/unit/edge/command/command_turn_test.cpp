#include "edge/command/command_turn.h"

#include <gmock/gmock.h>

#include "tests/unit/edge/station/station_fixture.h"

namespace ols::station {
namespace {

using testing::ElementsAre;
using testing::Pair;

class CommandTurnTest : public test::StationTest {
 protected:
  CommandTurnTest() { run_until(100.5); }
  void designate(double x_px) {
    turn_.designate({std::nullopt, {x_px, 469, 20, 20}}, {7, ++sequence_});
  }
  // Sequence and refusal of each decision.
  std::vector<std::pair<std::int64_t, Refusal>> end() {
    turn_.end(now_);
    std::vector<std::pair<std::int64_t, Refusal>> said;
    for (const Decision& one : turn_.take_decisions()) {
      said.emplace_back(one.command.sequence, one.refusal);
    }
    return said;
  }
  std::int64_t sequence_ = 0;
  CommandTurn turn_{station_};
};

TEST_F(CommandTurnTest, CarriesOutTheNewestDesignationAtItsEnd) {
  designate(100);
  designate(200);
  EXPECT_EQ(script_.initialised, 0);
  EXPECT_THAT(end(), ElementsAre(Pair(1, Refusal::kOvertaken), Pair(2, Refusal::kNone)));
  EXPECT_EQ(script_.initialised, 1);
  EXPECT_EQ(script_.first_box.x, 200.0);
  EXPECT_EQ(turn_.superseded(), 1U);
  EXPECT_TRUE(end().empty());
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
  EXPECT_THAT(end(), ElementsAre(Pair(1, Refusal::kStopped)));
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
  EXPECT_THAT(end(), ElementsAre(Pair(1, Refusal::kBox)));
}

}  // namespace
}  // namespace ols::station
