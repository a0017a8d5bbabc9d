#include "edge/device/reading_queue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::device {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ReadingQueue, GivesEachReadingOnceAndTheOldestFirst) {
  ReadingQueue<int> queue;
  EXPECT_THAT(queue.take(), IsEmpty());
  queue.add(1);
  queue.add(2);
  EXPECT_THAT(queue.take(), ElementsAre(1, 2));
  EXPECT_THAT(queue.take(), IsEmpty());
  queue.add(3);
  EXPECT_THAT(queue.take(), ElementsAre(3));
}

TEST(ReadingQueue, KeepsTheNewestWhenNobodyTakesThem) {
  constexpr int kMost = ReadingQueue<int>::kMost;
  ReadingQueue<int> queue;
  for (int i = 0; i < kMost; ++i) queue.add(i);
  queue.add(kMost);
  queue.add(kMost + 1);
  const auto readings = queue.take();
  ASSERT_EQ(readings.size(), ReadingQueue<int>::kMost);
  EXPECT_EQ(readings.front(), 2);
  EXPECT_EQ(readings.back(), kMost + 1);
  queue.add(7);
  EXPECT_THAT(queue.take(), ElementsAre(7));
}

}  // namespace
}  // namespace ols::device
