#include "export/packet_queue.h"

#include <gtest/gtest.h>

#include <map>
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
  queue.put({"a", "4"});
  EXPECT_EQ(queue.size(), 3U);
  EXPECT_EQ(queue.displaced(), 1U);
  EXPECT_EQ(all(queue), (std::vector<std::string>{"1", "2", "4"}));
  queue.put({"a", "5"});
  EXPECT_EQ(all(queue), (std::vector<std::string>{"5"}));
}

TEST(PacketQueue, OverASlowConnectionEachSubjectHasItsTurnInTheOrderOfTimes) {
  PacketQueue queue;
  std::map<std::string, int> sent;
  int before = -1;
  for (int time = 0; time < 30; ++time) {
    for (const char* subject : {"a", "b", "c"}) queue.put({subject, std::to_string(time)});
    const auto packet = queue.take();
    ++sent[packet->subject];
    EXPECT_LE(before, std::stoi(packet->bytes));
    before = std::stoi(packet->bytes);
  }
  EXPECT_EQ(sent, (std::map<std::string, int>{{"a", 10}, {"b", 10}, {"c", 10}}));
  EXPECT_GT(before, 24);
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
  EXPECT_EQ(all(queue), (std::vector<std::string>{"8", "9", "eight"}));
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
