#include "edge/ptu/poll_cycle.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/edge/ptu/unit_replies.h"

namespace ols::ptu {
namespace {

constexpr double kByte_s = 1e-3;

PtuRequest speeds_and_positions() {
  return PtuRequest().plain("PS1").plain("TS2").plain("PP3").plain("TP4");
}

PollCycle taken(const PtuRequest& commands, const std::vector<PtuReply>& replies,
                const PtuRequest& questions = {}) {
  PollCycle cycle(commands, questions, 10.0, kByte_s, 0.002);
  for (const PtuReply& each : replies) cycle.take(each, 0.0);
  return cycle;
}

TEST(PollCycle, PutsTheCommandsBetweenTheQueries) {
  const PollCycle cycle(speeds_and_positions(), PtuRequest().plain("O"), 10.0, kByte_s, 0.002);
  EXPECT_EQ(cycle.bytes(), " PP PS1 TS2 TP PP3 TP TP4 PP O ");
  EXPECT_NEAR(cycle.sent_out_s(), 10.031, 1e-9);
  EXPECT_NEAR(cycle.due_s(0.08), 10.031 + 9 * 14 * kByte_s + 0.08, 1e-9);
}

TEST(PollCycle, SortsTheRepliesByWhatWasAsked) {
  const PollCycle cycle = taken(speeds_and_positions(),
                                {reply("11"), reply(), reply(), reply("21"), reply(), reply("22"),
                                 refusal("no"), reply("12"), reply("30 VDC")},
                                PtuRequest().plain("O"));
  ASSERT_TRUE(cycle.complete());
  EXPECT_FALSE(cycle.spoilt());
  EXPECT_FALSE(cycle.command_lost());
  EXPECT_EQ(cycle.pan()[0].counts, 11);
  EXPECT_EQ(cycle.pan()[1].counts, 12);
  EXPECT_EQ(cycle.tilt()[0].counts, 21);
  EXPECT_EQ(cycle.tilt()[1].counts, 22);
  EXPECT_EQ(cycle.refusals(), std::vector<std::string>{"no"});
  ASSERT_EQ(cycle.answers().size(), 1u);
  EXPECT_EQ(cycle.answers()[0].text, "30 VDC");
}

TEST(PollCycle, NoticesTheLostReplyToACommand) {
  const PollCycle cycle =
      taken(PtuRequest().plain("H"), {reply("1"), reply("2"), reply("2"), reply("1")});
  EXPECT_TRUE(cycle.complete());
  EXPECT_TRUE(cycle.command_lost());
  EXPECT_FALSE(cycle.spoilt());
  EXPECT_EQ(cycle.pan()[1].counts, 1);
}

TEST(PollCycle, IsSpoiltByAPositionThatIsNone) {
  for (const PtuReply& bad : {reply(), reply("x"), refusal("Illegal"), reply("1.5")}) {
    EXPECT_TRUE(taken({}, {bad, reply("2"), reply("2"), reply("1")}).spoilt()) << bad.text;
  }
}

TEST(PollCycle, IsSpoiltByMoreRepliesThanWereAsked) {
  const std::vector<PtuReply> all{reply("1"), reply("2"), reply("2"), reply("1")};
  PollCycle cycle = taken({}, all);
  EXPECT_TRUE(cycle.complete());
  EXPECT_FALSE(cycle.spoilt());
  cycle.take(reply("1"), 0.0);
  EXPECT_TRUE(cycle.spoilt());
}

TEST(PollCycle, NoticesEchoAndVerboseReplies) {
  PtuReply echoed = reply("1");
  echoed.echoed = true;
  PtuReply verbose = reply("Current Pan position is 1");
  verbose.number = 1.0;
  for (const PtuReply& first : {echoed, verbose}) {
    const PollCycle cycle = taken({}, {first, reply("2"), reply("2"), reply("1")});
    EXPECT_TRUE(cycle.modes_forgotten());
    EXPECT_FALSE(cycle.spoilt());
  }
}

TEST(PollCycle, MeasuresTheLatencyAtTheFirstQuery) {
  // The query's end is on the line at 4 ms, the reply starts 5 ms later.
  const PollCycle cycle = taken({}, {reply("1", 10.010, 10.013)});
  EXPECT_NEAR(cycle.latency_s(), 0.005, 1e-9);
}

}  // namespace
}  // namespace ols::ptu
