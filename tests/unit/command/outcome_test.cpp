#include "command/outcome.h"

#include <gtest/gtest.h>

namespace ols::command {
namespace {

TEST(Outcome, IsUnknownUntilTheStationCountsTheOrder) {
  const Reply before{.counters = {{"designate_accepted", 2}, {"refused_stale", 1}}};
  EXPECT_FALSE(outcome(before, before, Kind::kDesignate));
}

TEST(Outcome, AGrownCountOfItsKindIsAcceptance) {
  const Reply before{.counters = {{"designate_accepted", 2}}};
  const Reply now{.counters = {{"designate_accepted", 3}}};
  EXPECT_TRUE(outcome(before, now, Kind::kDesignate)->accepted);
  EXPECT_FALSE(outcome(before, now, Kind::kPoint));
}

TEST(Outcome, ARefusalIsInTheStationsWords) {
  const Reply before{};
  const Reply now{.counters = {{"refused_recorder", 1}}, .last_error = "RECORD refused: disk full"};
  EXPECT_EQ(outcome(before, now, Kind::kRecord)->why,
            "refused: recorder (RECORD refused: disk full)");
  const Reply stopped{.counters = {{"refused_just_stopped", 1}}};
  EXPECT_EQ(outcome(before, stopped, Kind::kPoint)->why,
            "refused: it was stopped less than a second ago; try again");
  const Reply too_old{.counters = {{"refused_no_frame", 1}}, .last_error = "no_frame"};
  EXPECT_EQ(outcome(before, too_old, Kind::kDesignate)->why,
            "refused: that picture is too old; try again on the one of now");
}

TEST(Outcome, AStationsLastErrorIsASentence) {
  EXPECT_EQ(error_in_words("SLEW refused: precedence"),
            "slew refused: an operator has the station, or it is stopped; release it first");
  EXPECT_EQ(error_in_words("RECORD refused: disk full"), "RECORD refused: disk full");
  EXPECT_EQ(error_in_words("ptu: no reply"), "ptu: no reply");
}

TEST(Outcome, WithoutAnswerALostMessageIsTheReasonIfOneWasCounted) {
  EXPECT_EQ(without_answer({}, {}).why, "no answer");
  const Reply now{.counters = {{"messages_refused_schema", 1}}};
  EXPECT_EQ(without_answer({}, now).why, "refused: the message is of another version");
  EXPECT_FALSE(without_answer({}, now).accepted);
}

TEST(Outcome, AStopIsConfirmedByACountAndAStandingUnit) {
  const Reply before{.counters = {{"stop_accepted", 4}}};
  const Reply counted{.counters = {{"stop_accepted", 5}}};
  EXPECT_FALSE(confirms_stop(before, counted));
  const Reply standing{.counters = {{"stop_accepted", 5}}, .stopped = true};
  EXPECT_TRUE(confirms_stop(before, standing));
  EXPECT_FALSE(confirms_stop(standing, standing));
}

// As from a recording of yesterday, when it had counted more.
TEST(Outcome, AStatusOfAnotherBootAnswersNothing) {
  const Reply before{.counters = {{"stop_accepted", 4}}, .boot_id = 2};
  const Reply recorded{.counters = {{"stop_accepted", 9},
                                    {"home_accepted", 3},
                                    {"refused_stale", 7},
                                    {"messages_refused_schema", 2}},
                       .stopped = true,
                       .boot_id = 1};
  EXPECT_FALSE(confirms_stop(before, recorded));
  EXPECT_FALSE(outcome(before, recorded, Kind::kHome));
  EXPECT_FALSE(outcome(before, recorded, Kind::kPoint)) << "nor is it refused";
  EXPECT_EQ(without_answer(before, recorded).why, "no answer");
}

}  // namespace
}  // namespace ols::command
