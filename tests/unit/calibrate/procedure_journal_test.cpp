#include "tools/calibrate/procedure_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::calibration {
namespace {

using Event = JournalEntry::Kind;

TEST(ProcedureJournal, WhatIsWrittenIsRead) {
  JournalEntry taken{Event::kTaken, "sweep, picture 3 of 60", 7, "", {}};
  JournalEntry missed{Event::kNotTaken, "mast: driving there", 0, "a \"reason\"\nof two lines", {}};
  JournalEntry pointed{Event::kAnswered, "mast: where is it?", 0, "", {}};
  pointed.answer = {"point", Eigen::Vector2d(640.25, 1.0 / 3.0), {0.1, -0.2}, 1790000000123456};
  JournalEntry plain{Event::kAnswered, "result", 0, "", {"redo", {}, {}}};
  plain.ordered_utime_us = 1790000000654321;
  const JournalEntry resumed{Event::kResumed, "", 0, "", {}};
  std::string text;
  for (const JournalEntry& one : {taken, missed, pointed, plain, resumed}) {
    text += journal_line(one) + "\n";
  }
  const auto read = journal_entries(text, "journal.jsonl");
  ASSERT_EQ(read.size(), 5U);
  EXPECT_EQ(read[0].pose, 7);
  EXPECT_EQ(read[1].kind, Event::kNotTaken);
  EXPECT_EQ(read[1].why, missed.why);
  EXPECT_EQ(read[2].answer.choice, "point");
  EXPECT_EQ(*read[2].answer.pixel, *pointed.answer.pixel);
  EXPECT_EQ(read[2].answer.turn.tilt_rad, -0.2);
  EXPECT_EQ(read[2].answer.utime_us, 1790000000123456);
  EXPECT_FALSE(read[3].answer.pixel);
  EXPECT_EQ(read[3].ordered_utime_us, 1790000000654321);
  EXPECT_EQ(read[0].ordered_utime_us, 0) << "of a journal that does not say";
  EXPECT_EQ(read[4].kind, Event::kResumed);
}

TEST(ProcedureJournal, ALastLineThatWasCutIsLeftOutAndAnotherIsNamed) {
  const std::string good = journal_line({Event::kTaken, "a", 1, "", {}}) + "\n";
  EXPECT_EQ(journal_entries(good + R"({"step": "b", "ta)", "j").size(), 1U);
  EXPECT_THAT([&] { journal_entries(good + "{\"step\": \"b\"}\n", "j"); },
              testing::ThrowsMessage<std::runtime_error>(testing::StartsWith("j:2: ")));
}

TEST(ProcedureJournal, AnEntryBelongsToTheSameOrderWhateverItsFigures) {
  Order drive;
  drive.step = "mast: driving there; mast would leave 21.3″";
  const JournalEntry taken{Event::kTaken, "mast: driving there; mast would leave 21.4″", 1, "", {}};
  EXPECT_TRUE(answers(taken, drive));
  drive.step = "barn: driving there; barn would leave 21.3″";
  EXPECT_FALSE(answers(taken, drive));
  Order ask;
  ask.kind = Order::Kind::kAsk;
  ask.step = taken.step;
  EXPECT_FALSE(answers(taken, ask));
}

}  // namespace
}  // namespace ols::calibration
