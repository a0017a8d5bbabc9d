#include "edge/ptu/mode_check.h"

#include <gtest/gtest.h>

#include "tests/unit/edge/ptu/unit_replies.h"

namespace ols::ptu {
namespace {

using Result = ModeCheck::Result;

constexpr std::int32_t kAcceleration = 18000;

PollCycle cycle(bool echoes, const PtuReply& mode = {}, const PtuReply& acceleration = {}) {
  PollCycle made({}, ModeCheck::questions(), 0.0, 1e-3, 0.0);
  PtuReply first = reply("1");
  first.echoed = echoes;
  for (const PtuReply& each : {first, reply("2"), reply("2"), reply("1"), mode, acceleration}) {
    made.take(each, 0.0);
  }
  return made;
}

class ModeCheckTest : public testing::Test {
 protected:
  Result next(const PollCycle& done) {
    check_.begin_cycle();
    return check_.take(done);
  }
  ModeCheck check_{kAcceleration};
};

TEST_F(ModeCheckTest, IsNotNeededWhileTheRepliesAreTerse) {
  EXPECT_EQ(next(cycle(false)), Result::kUnchanged);
  EXPECT_FALSE(check_.needed());
}

TEST_F(ModeCheckTest, EndsWhenTheUnitIsAsItWas) {
  EXPECT_EQ(next(cycle(true)), Result::kForgotten);
  EXPECT_TRUE(check_.needed());
  EXPECT_EQ(next(cycle(false, reply("i"), reply("18000"))), Result::kRestored);
  EXPECT_FALSE(check_.needed());
}

TEST_F(ModeCheckTest, TakesAUnitWithOtherAnswersForRestarted) {
  for (const auto& [mode, acceleration] :
       {std::pair(reply("i"), reply("2000")), std::pair(reply("p"), reply("18000")),
        std::pair(reply("i"), refusal("18000"))}) {
    check_ = ModeCheck(kAcceleration);
    next(cycle(true));
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(next(cycle(false, mode, acceleration)), Result::kUnchanged);
    }
    EXPECT_EQ(next(cycle(false, mode, acceleration)), Result::kUnitRestarted);
    EXPECT_TRUE(check_.needed());
  }
}

}  // namespace
}  // namespace ols::ptu
