#include "edge/ptu/starting.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/ptu/unit_replies.h"

namespace ols::ptu {
namespace {

using Event = PtuStarting::Event;

constexpr double kByte_s = 1e-3, kTimeout_s = 0.5;

class Starting : public testing::Test {
 protected:
  // Advances in milliseconds until something happens or until `end_s`.
  PtuStarting::Step until_event(double end_s, bool emergency = false) {
    while (time_s_ < end_s) {
      PtuStarting::Step step = starting_.step(time_s_ += 1e-3, kByte_s, emergency);
      if (step.event != Event::kNone || !step.bytes.empty()) return step;
    }
    return {};
  }
  // Through the flush up to the first command.
  void ask() {
    EXPECT_EQ(until_event(1.0).bytes, " ");
    EXPECT_EQ(until_event(1.0).event, Event::kLineDropped);
    EXPECT_EQ(until_event(1.0).bytes, "ED ");
  }
  PtuCounters counters_;
  double time_s_ = 0.0;
  PtuStarting starting_{{}, kTimeout_s, PtuStarting::Purpose::kDrive, time_s_, counters_};
};

TEST_F(Starting, AsksOnceTheLineIsQuiet) {
  EXPECT_EQ(until_event(1.0).bytes, " ");
  while (time_s_ < 0.5) {  // a banner
    EXPECT_EQ(until_event(time_s_ + 0.02).event, Event::kNone);
    starting_.bytes_came(time_s_);
    EXPECT_FALSE(starting_.waits_for_reply());
  }
  EXPECT_EQ(until_event(1.0).event, Event::kLineDropped);
  EXPECT_NEAR(time_s_, 0.5 + 0.06 + kByte_s, 0.005);
  EXPECT_EQ(until_event(1.0).bytes, "ED ");
  EXPECT_TRUE(starting_.waits_for_reply());
  EXPECT_EQ(counters_.requests, 1u);
}

TEST_F(Starting, GivesUpALineThatIsNeverQuiet) {
  Event event = Event::kNone;
  while (event == Event::kNone && time_s_ < 5.0) {
    event = starting_.step(time_s_ += 0.01, kByte_s, false).event;
    starting_.bytes_came(time_s_);
  }
  EXPECT_EQ(event, Event::kLineNotQuiet);
  EXPECT_NEAR(time_s_, 2.0, 0.1);
}

TEST_F(Starting, BeginsWithAHaltInAnEmergency) {
  EXPECT_EQ(until_event(1.0, true).bytes, halt_request());
}

TEST_F(Starting, AUnitThatNeverAnsweredIsAskedOnce) {
  ask();
  EXPECT_EQ(until_event(2.0).event, Event::kNoReply);
  EXPECT_EQ(starting_.asked(), "ED");
  EXPECT_EQ(counters_.timeouts, 1u);
  EXPECT_FALSE(starting_.answered());
}

TEST_F(Starting, AUnitThatAnsweredIsAskedTwiceMoreInAll) {
  ask();
  EXPECT_TRUE(starting_.take(reply()));
  for (int retry = 0; retry < 2; ++retry) {
    EXPECT_EQ(until_event(20.0).bytes, "FT ");
    EXPECT_EQ(until_event(20.0).event, Event::kLineDropped) << retry;  // silence; flushed again
    EXPECT_EQ(until_event(20.0).bytes, " ");
    EXPECT_EQ(until_event(20.0).event, Event::kLineDropped);
  }
  EXPECT_EQ(until_event(20.0).bytes, "FT ");
  EXPECT_EQ(until_event(20.0).event, Event::kNoReply);
  EXPECT_EQ(counters_.timeouts, 3u);
}

TEST_F(Starting, SaysWhichReplyCannotBeUsed) {
  ask();
  for (const char* next : {"FT ", "H ", "CI "}) {
    EXPECT_TRUE(starting_.take(reply()));
    EXPECT_FALSE(starting_.waits_for_reply());
    EXPECT_EQ(until_event(20.0).bytes, next);
  }
  const PtuReply refused = refusal("Illegal");
  EXPECT_FALSE(starting_.take(refused));
  EXPECT_EQ(starting_.refusal(refused),
            "the unit may be in velocity mode: unusable reply to CI: ! Illegal");
  EXPECT_EQ(counters_.errors, 1u);
}

}  // namespace
}  // namespace ols::ptu
