#include "sim/network/relay_queue.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ols::sim {
namespace {

Packet numbered(int number) { return {"OLS_BEARING_alfa", {static_cast<std::uint8_t>(number)}}; }

std::vector<int> numbers(const std::vector<Packet>& packets) {
  std::vector<int> result;
  for (const Packet& packet : packets) result.push_back(packet.data.at(0));
  return result;
}

TEST(RelayQueue, WithoutImpairmentsPassesAllInOrder) {
  RelayQueue queue({.delay_s = 0.01}, 1);
  for (int i = 0; i < 5; ++i) queue.offer(numbered(i), 0.0);
  EXPECT_TRUE(queue.take(0.009).empty());
  EXPECT_EQ(numbers(queue.take(0.011)), (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(queue.counts().sent, 5U);
  EXPECT_EQ(queue.size(), 0U);
}

RelayCounts of_many(const Impairments& impairments, std::uint64_t seed) {
  RelayQueue queue(impairments, seed);
  for (int i = 0; i < 20000; ++i) {
    queue.offer(numbered(0), 1.0 * i);
    queue.take(1.0 * i + 0.5);
  }
  return queue.counts();
}

TEST(RelayQueue, LosesDoublesAndReordersAsOftenAsStated) {
  const RelayCounts c = of_many({.loss = 0.05, .duplicate = 0.05, .reorder = 0.05}, 7);
  EXPECT_EQ(c.received, 20000U);
  EXPECT_NEAR(static_cast<double>(c.lost), 1000.0, 120.0);
  EXPECT_NEAR(static_cast<double>(c.duplicated), 950.0, 120.0);
  EXPECT_NEAR(static_cast<double>(c.reordered), 997.0, 120.0);
  EXPECT_EQ(c.sent, c.received - c.lost + c.duplicated);
}

TEST(RelayQueue, AReorderedOneIsOvertaken) {
  RelayQueue queue({.reorder = 0.3, .reorder_s = 0.05}, 3);
  std::vector<int> order;
  for (int i = 0; i < 100; ++i) {
    queue.offer(numbered(i), 0.01 * i);
    for (const int n : numbers(queue.take(0.01 * i))) order.push_back(n);
  }
  EXPECT_FALSE(std::is_sorted(order.begin(), order.end()));
}

TEST(RelayQueue, TheSameSeedMakesTheSameChoice) {
  const auto choice = [](std::uint64_t seed, double spacing_s) {
    RelayQueue queue({.loss = 0.3, .duplicate = 0.3, .reorder = 0.3}, seed);
    for (int i = 0; i < 200; ++i) queue.offer(numbered(i), spacing_s * i);
    std::vector<int> passed = numbers(queue.take(1e9));
    std::sort(passed.begin(), passed.end());
    return passed;
  };
  EXPECT_EQ(choice(5, 0.01), choice(5, 0.02));  // whatever the times are
  EXPECT_NE(choice(5, 0.01), choice(6, 0.01));
}

TEST(RelayQueue, IsBounded) {
  RelayQueue queue({.delay_s = 10.0, .capacity = 20}, 1);
  for (int i = 0; i < 100; ++i) queue.offer(numbered(i), 0.0);
  EXPECT_EQ(queue.size(), 20U);
  EXPECT_EQ(queue.counts().overflowed, 80U);
}

}  // namespace
}  // namespace ols::sim
