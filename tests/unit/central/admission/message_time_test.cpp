#include "central/admission/message_time.h"

#include <gtest/gtest.h>

namespace ols::fusion {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;

TEST(MessageTime, NowIsTheLowerMedianOfTheNewestStamps) {
  MessageTime time;
  EXPECT_EQ(time.now_us(), 0);
  time.hear("a", kStart);
  time.hear("b", kStart + 1000);
  EXPECT_EQ(time.now_us(), kStart);
  time.hear("c", kStart + 50'000'000);  // one wrong clock affects only its own station
  EXPECT_EQ(time.now_us(), kStart + 1000);
}

TEST(MessageTime, WhoIsSilentDoesNotCount) {
  MessageTime time(0.3);
  time.hear("silent", kStart);
  for (int i = 1; i <= 5; ++i) {
    time.hear("a", kStart + i * 100'000);
    time.hear("b", kStart + i * 100'000);
  }
  EXPECT_EQ(time.delivering(), (std::vector<std::string>{"a", "b"}));
  EXPECT_NEAR(time.silent_s("silent"), 0.4, 1e-9);
  EXPECT_EQ(time.newest_us("silent"), kStart);
}

TEST(MessageTime, ThreeStampsFarBackAreAStep) {
  MessageTime time;
  time.hear("a", kStart + 10'000'000);
  EXPECT_FALSE(time.hear("a", kStart));
  EXPECT_FALSE(time.hear("a", kStart + 40'000));
  EXPECT_EQ(time.now_us(), kStart + 10'000'000);
  EXPECT_TRUE(time.hear("a", kStart + 80'000));
  EXPECT_EQ(time.now_us(), kStart + 80'000);
}

TEST(MessageTime, WhoIsNotTrustedDoesNotCountWhileThereIsAnother) {
  MessageTime time;
  time.hear("a", kStart);
  time.hear("b", kStart + 7000);
  time.trust("a", false);
  EXPECT_EQ(time.now_us(), kStart + 7000);
  EXPECT_EQ(time.middle_us(), kStart);
  time.forget("b");
  EXPECT_EQ(time.now_us(), kStart);
}

TEST(MessageTime, OneLeapMakesNobodySilent) {
  MessageTime time(0.3);
  time.hear("a", kStart);
  time.hear("b", kStart);
  time.hear("b", kStart + 3'600'000'000);
  EXPECT_EQ(time.delivering_count(), 2U);
  EXPECT_LT(time.elapsed_s(), 0.3);
}

}  // namespace
}  // namespace ols::fusion
