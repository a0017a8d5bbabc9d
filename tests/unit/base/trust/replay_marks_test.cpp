#include "base/trust/replay_marks.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/base/trust/site_fixture.h"

namespace ols::trust {
namespace {

constexpr const char* kChannel = "OLS_BEARING_alfa";

class Marks : public testing::Test {
 protected:
  // Whether it is new; then it is noted.
  bool hear(std::int64_t boot, std::int64_t sequence, std::int64_t utime_us = 100,
            const char* channel = kChannel) {
    const MessageHead head{utime_us, "", boot, sequence};
    if (marks_.is_replayed(key_, channel, head)) return false;
    marks_.note(key_, channel, head);
    return true;
  }

  KeyId key_{1, 2, 3};
  ReplayMarks marks_;
};

TEST_F(Marks, NothingIsHeardTwice) {
  for (std::int64_t sequence = 1; sequence <= 300; ++sequence) EXPECT_TRUE(hear(7, sequence));
  for (std::int64_t sequence = 1; sequence <= 300; ++sequence) EXPECT_FALSE(hear(7, sequence));
}

TEST_F(Marks, DatagramsMayOvertakeEachOtherByLessThanTheWindow) {
  EXPECT_TRUE(hear(7, 100));
  EXPECT_TRUE(hear(7, 37));
  EXPECT_FALSE(hear(7, 37));
  EXPECT_FALSE(hear(7, 36)) << "beyond the window";
  EXPECT_TRUE(hear(7, 99));
  EXPECT_TRUE(hear(7, 100 + 64));
  EXPECT_FALSE(hear(7, 100)) << "beyond it now";
  EXPECT_TRUE(hear(7, 101));
  EXPECT_FALSE(hear(7, 164));
}

TEST_F(Marks, ChannelsKeysAndBootsAreApart) {
  EXPECT_TRUE(hear(7, 50));
  EXPECT_TRUE(hear(7, 50, 100, "OLS_STATUS_alfa"));
  EXPECT_TRUE(hear(8, 1)) << "a restart begins anew";
  EXPECT_FALSE(hear(7, 50)) << "and the old boot stays heard";
  EXPECT_TRUE(hear(7, 51)) << "it may be alive";
  key_ = {4};
  EXPECT_TRUE(hear(7, 50));
}

TEST_F(Marks, AForgottenBootDoesNotComeBackByItsOldMessages) {
  for (std::int64_t boot = 1; boot <= 40; ++boot) EXPECT_TRUE(hear(boot, 5, 1000 * boot));
  EXPECT_FALSE(hear(1, 5, 1000));
  EXPECT_FALSE(hear(1, 6, 1001)) << "never heard, but stamped before what was forgotten";
  EXPECT_TRUE(hear(1, 7, 100'000)) << "alive after all";
  EXPECT_TRUE(marks_.is_replayed(key_, kChannel, {1000, "", 2, 5}));
  EXPECT_FALSE(marks_.is_heard(key_, kChannel, {1000, "", 2, 5})) << "as far as is remembered";
  EXPECT_TRUE(marks_.is_heard(key_, kChannel, {1000, "", 40, 5}));
}

TEST_F(Marks, ExtremeSequencesAreOrderedToo) {
  constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
  constexpr auto kGreatest = std::numeric_limits<std::int64_t>::max();
  EXPECT_TRUE(hear(7, kLeast));
  EXPECT_TRUE(hear(7, kGreatest));
  EXPECT_FALSE(hear(7, kLeast));
  EXPECT_FALSE(hear(7, kGreatest));
  EXPECT_TRUE(hear(7, kGreatest - 1));
}

TEST_F(Marks, OutlastARestart) {
  EXPECT_TRUE(hear(7, 50));
  EXPECT_TRUE(hear(7, 48));
  for (std::int64_t boot = 100; boot < 140; ++boot) EXPECT_TRUE(hear(boot, 1, 9000 + boot));
  const std::string kept = marks_.text();
  marks_ = {};
  EXPECT_EQ(marks_.read(kept), 0U);
  EXPECT_FALSE(hear(139, 1));
  EXPECT_FALSE(hear(7, 50, 100)) << "forgotten, but not the time";
  EXPECT_FALSE(hear(7, 51, 9100));
  EXPECT_TRUE(hear(139, 2));
  EXPECT_EQ(marks_.read("nonsense\n" + kept + "0102 x 1 2 3 4 5\nzz02030405060708 x 1 2 3 4 5\n"),
            3U);
}

}  // namespace
}  // namespace ols::trust
