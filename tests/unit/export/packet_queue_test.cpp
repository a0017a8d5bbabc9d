#include "export/packet_queue.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ols::exports {
namespace {

std::vector<std::string> all(PacketQueue& queue) {
  std::vector<std::string> bytes;
  while (const auto packet = queue.take()) bytes.push_back(packet->bytes);
  return bytes;
}

TEST(PacketQueue, TheNewestOfASubjectWinsAndWaitsBehindWhatIsOlder) {
  PacketQueue queue;
  queue.put({"a", "1"});
  queue.put({"b", "2"});
  queue.put({"a", "3"});
  EXPECT_EQ(queue.size(), 2U);
  EXPECT_EQ(queue.displaced(), 1U);
  EXPECT_EQ(all(queue), (std::vector<std::string>{"2", "3"}));
  queue.put({"a", "4"});
  EXPECT_EQ(all(queue), (std::vector<std::string>{"4"}));
}

TEST(PacketQueue, WithoutASubjectNoneIsReplaced) {
  PacketQueue queue;
  queue.put({"", "1"});
  queue.put({"", "2"});
  EXPECT_EQ(all(queue), (std::vector<std::string>{"1", "2"}));
}

TEST(PacketQueue, TheOldestGivesWay) {
  PacketQueue queue(3);
  for (int i = 0; i < 10; ++i) queue.put({std::to_string(i), std::to_string(i)});
  EXPECT_EQ(queue.displaced(), 7U);
  queue.put({"8", "eight"});
  EXPECT_EQ(all(queue), (std::vector<std::string>{"7", "9", "eight"}));
}

TEST(PacketQueue, WhatIsClearedWasDisplaced) {
  PacketQueue queue;
  queue.put({"a", "1"});
  queue.put({"b", "2"});
  queue.clear();
  EXPECT_EQ(queue.displaced(), 2U);
  queue.put({"b", "3"});
  EXPECT_EQ(all(queue), (std::vector<std::string>{"3"}));
}

}  // namespace
}  // namespace ols::exports
