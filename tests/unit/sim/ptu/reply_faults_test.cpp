#include "sim/ptu/reply_faults.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace ols::sim {
namespace {

const std::string kReply = "* -12345\r\n";

// The reply with its longest common begin and end with the right one cut off.
std::string left_over(std::string right, std::string heard) {
  while (!right.empty() && !heard.empty() && right.front() == heard.front()) {
    right.erase(0, 1);
    heard.erase(0, 1);
  }
  while (!right.empty() && !heard.empty() && right.back() == heard.back()) {
    right.pop_back();
    heard.pop_back();
  }
  return std::to_string(right.size()) + " for " + std::to_string(heard.size());
}

TEST(PtuReplyFaults, ChangesNothingUnlessAsked) {
  PtuReplyFaults faults(1);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(faults.pass(kReply, i), kReply);
}

TEST(PtuReplyFaults, GarblesOneByteOfAReply) {
  PtuReplyFaults faults(1);
  faults.set(1.0, 0.0, 0.0);
  std::set<std::string> kinds;
  for (int i = 0; i < 500; ++i) {
    const std::string heard = faults.pass(kReply, i);
    if (heard == kReply) continue;  // a lost byte may look like none beside an equal one
    kinds.insert(left_over(kReply, heard));
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"1 for 1", "1 for 0", "0 for 1"}));
  EXPECT_EQ(faults.garbled(), 500U);
}

TEST(PtuReplyFaults, GarblesTheShareThatIsAskedFor) {
  PtuReplyFaults faults(2);
  faults.set(0.1, 0.0, 0.0);
  for (int i = 0; i < 5000; ++i) faults.pass("*\r\n", i);
  EXPECT_NEAR(static_cast<double>(faults.garbled()), 500.0, 70.0);
}

TEST(PtuReplyFaults, DoesNotDependOnThePiecesThatBytesComeIn) {
  PtuReplyFaults whole(3), pieces(3);
  whole.set(0.5, 3.0, 0.0);
  pieces.set(0.5, 3.0, 0.0);
  std::string heard;
  for (int i = 0; i < 100; ++i) {
    std::string one_by_one;
    for (const char byte : kReply) one_by_one += pieces.pass({&byte, 1}, i);
    heard = whole.pass(kReply, i);
    EXPECT_EQ(one_by_one, heard);
  }
}

TEST(PtuReplyFaults, LosesAReplyFromTimeToTime) {
  PtuReplyFaults faults(1);
  faults.set(0.0, 2.0, 10.0);
  std::string heard;
  for (int i = 0; i < 80; ++i) {
    heard += faults.pass("*\r\n", 10.0 + 0.1 * i).empty() ? std::to_string(i) + " " : "";
  }
  EXPECT_EQ(heard, "20 40 60 ");
  EXPECT_EQ(faults.lost(), 3U);
}

}  // namespace
}  // namespace ols::sim
