#include "sim/network/flood.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "ols_msg/slew_t.hpp"
#include "tests/unit/on_the_bus.h"

namespace ols::sim {
namespace {

TEST(Flood, ComesByForeignAndOwnChannelsOfABoundedNumberOfNames) {
  Flood flood({"alfa"}, 50, 1);
  std::set<std::string> names;
  int own = 0;
  for (int i = 0; i < 20000; ++i) {
    const Packet packet = flood.next();
    EXPECT_LE(packet.channel.size(), 63U);
    names.insert(packet.channel);
    own += packet.channel.starts_with("OLS_") ? 1 : 0;
  }
  EXPECT_NEAR(own, 10000, 500);
  EXPECT_LE(names.size(), 50U + 9U + 7U * 50U);
  EXPECT_TRUE(names.contains("OLS_PTU_alfa"));
  EXPECT_TRUE(names.contains("OLS_TARGET"));
}

TEST(Flood, SomeHaveTheRightFingerprintSomeNot) {
  Flood flood({"alfa"}, 50, 1);
  auto fingerprint = encoded(ols_msg::slew_t{});
  fingerprint.resize(8);
  int right = 0, wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const Packet packet = flood.next();
    if (packet.channel != "OLS_SLEW_alfa") continue;
    const bool same = packet.data.size() >= 8 &&
                      std::equal(fingerprint.begin(), fingerprint.end(), packet.data.begin());
    ++(same ? right : wrong);
  }
  EXPECT_GT(right, 100);
  EXPECT_GT(wrong, 100);
}

TEST(Flood, TheSameSeedGivesTheSameMessages) {
  Flood one({"alfa", "bravo"}, 50, 4), two({"alfa", "bravo"}, 50, 4);
  for (int i = 0; i < 1000; ++i) {
    const Packet a = one.next(), b = two.next();
    EXPECT_EQ(a.channel, b.channel);
    EXPECT_EQ(a.data, b.data);
  }
}

TEST(Flood, EachUnknownChannelHasANameOfItsOwn) {
  std::set<std::string> names;
  for (std::uint64_t i = 0; i < 10000; ++i) names.insert(unknown_channel(i).channel);
  EXPECT_EQ(names.size(), 10000U);
  EXPECT_FALSE(names.begin()->starts_with("OLS_"));
  EXPECT_LE(unknown_channel(2'000'000'000).channel.size(), 63U);
}

}  // namespace
}  // namespace ols::sim
