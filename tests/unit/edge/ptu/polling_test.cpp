#include "edge/ptu/polling.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/ptu/unit_replies.h"

namespace ols::ptu {
namespace {

constexpr double kInterval_s = 0.1, kByte_s = 1e-4;

class PollingTest : public testing::Test {
 protected:
  void send(double time_s) { polling_.send({}, {}, time_s); }
  std::optional<PollCycle> answer(double time_s) {
    polling_.bytes_came(time_s);
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(polling_.take(reply("1"), 0.0));
    return polling_.take(reply("1"), 0.0);
  }
  Polling polling_{kInterval_s, kByte_s, 0.0};
};

TEST_F(PollingTest, SendsOneCycleAtATimeAtItsInterval) {
  EXPECT_TRUE(polling_.due(0.0));
  send(0.0);
  EXPECT_FALSE(polling_.due(1.0));  // one is under way
  EXPECT_TRUE(answer(0.01));
  EXPECT_FALSE(polling_.under_way());
  EXPECT_FALSE(polling_.due(0.099));
  EXPECT_TRUE(polling_.due(0.1));
}

TEST_F(PollingTest, GivesUpAGarbledCycleOnceTheLineIsQuietAndPollsAtOnce) {
  send(0.0);
  polling_.bytes_came(0.01);
  polling_.line_was_garbled();
  EXPECT_FALSE(polling_.watch(0.029));
  EXPECT_EQ(polling_.watch(0.031), Polling::Failure::kGarbled);
  EXPECT_TRUE(polling_.due(0.031));
}

TEST_F(PollingTest, WaitsForAQuietLineAfterMissingReplies) {
  send(0.0);
  EXPECT_FALSE(polling_.watch(0.05));
  EXPECT_EQ(polling_.watch(0.15), Polling::Failure::kRepliesMissing);
  polling_.bytes_came(0.16);  // a late one
  EXPECT_FALSE(polling_.due(0.21));
  EXPECT_TRUE(polling_.due(0.23));
}

TEST_F(PollingTest, WaitsForAQuietLineAfterAReplyThatItDidNotExpect) {
  polling_.bytes_came(0.05);
  polling_.unexpected_reply();
  EXPECT_FALSE(polling_.due(0.06));
  EXPECT_TRUE(polling_.due(0.071));
}

TEST_F(PollingTest, DropsWhatIsUnderWayWhenOtherBytesAreWritten) {
  send(0.0);
  polling_.abandon(0.02);
  EXPECT_FALSE(polling_.under_way());
  EXPECT_FALSE(polling_.due(0.03));
  EXPECT_TRUE(polling_.due(0.041));
}

TEST_F(PollingTest, KnowsForHowLongTheLineWasSilent) {
  polling_.bytes_came(1.0);
  EXPECT_FALSE(polling_.silent_for(0.5, 1.5));
  EXPECT_TRUE(polling_.silent_for(0.5, 1.51));
}

}  // namespace
}  // namespace ols::ptu
