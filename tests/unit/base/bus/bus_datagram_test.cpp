#include "base/bus/bus_datagram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace ols {
namespace {

using testing::ElementsAreArray;

std::vector<std::uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

DatagramFault fault_of(const std::string& text) {
  const auto bytes = bytes_of(text);
  const auto parsed = parse_datagram(bytes);
  const auto* fault = std::get_if<DatagramFault>(&parsed);
  EXPECT_NE(fault, nullptr) << "accepted";
  return fault == nullptr ? DatagramFault{} : *fault;
}

TEST(BusDatagram, IsWhatLcmPutsOnTheWire) {
  const std::vector<std::uint8_t> payload{1, 0, 255};
  const auto bytes = make_datagram(0x01020304, "OLS_A", payload);
  EXPECT_THAT(bytes,
              ElementsAreArray(bytes_of(std::string("LC02\x01\x02\x03\x04OLS_A\0\x01\0\xff", 17))));
  const auto parsed = parse_datagram(bytes);
  ASSERT_TRUE(std::holds_alternative<BusDatagram>(parsed));
  const auto& datagram = std::get<BusDatagram>(parsed);
  EXPECT_EQ(datagram.sequence, 0x01020304U);
  EXPECT_EQ(datagram.channel, "OLS_A");
  EXPECT_THAT(datagram.payload, ElementsAreArray(payload));
}

TEST(BusDatagram, AMessageWithoutBytesIsOne) {
  const auto parsed = parse_datagram(make_datagram(0, "A", {}));
  ASSERT_TRUE(std::holds_alternative<BusDatagram>(parsed));
  EXPECT_TRUE(std::get<BusDatagram>(parsed).payload.empty());
}

// The first of the two datagrams that ended every process of a site.
TEST(BusDatagram, EveryFragmentIsRefusedWhateverItSaysOfItself) {
  const std::string header("LC03\0\0\0\7\0\0\0\x64\0\0\0\0\0\0\0\3", 20);
  EXPECT_EQ(fault_of(header + "OLS_STATUS_x" + std::string(1, '\0') + "AAAA"),
            DatagramFault::kFragment);
  EXPECT_EQ(fault_of(std::string("LC03\0\0\0\7\0\0\0\x64\xff\xff\xff\0\0\1\0\3", 20) +
                     std::string(272, 'B')),
            DatagramFault::kFragment);
  EXPECT_EQ(fault_of("LC03xxxx"), DatagramFault::kFragment);
}

TEST(BusDatagram, WhatIsNoLcmIsForeign) {
  for (const char* text : {"", "L", "LC02", "LC02abc", "LC01aaaaA", "HELLO WORLD"}) {
    EXPECT_EQ(fault_of(text), DatagramFault::kForeign) << text;
  }
}

TEST(BusDatagram, AChannelHasAPrintableNameOfLcmsLengthThatEnds) {
  const std::string start = "LC02abcd";
  const std::string end(1, '\0');
  EXPECT_EQ(fault_of(start), DatagramFault::kChannel);
  EXPECT_EQ(fault_of(start + end), DatagramFault::kChannel);
  EXPECT_EQ(fault_of(start + "OLS_STATUS_x"), DatagramFault::kChannel);
  EXPECT_EQ(fault_of(start + std::string(64, 'A') + end), DatagramFault::kChannel);
  for (const char* name : {"\x1b[2J", "A B", "A\n", "\x7f", "\xc3\xa9"}) {
    EXPECT_EQ(fault_of(start + name + end), DatagramFault::kChannel) << name;
  }
  const auto longest = bytes_of(start + std::string(63, 'A') + end);
  EXPECT_TRUE(std::holds_alternative<BusDatagram>(parse_datagram(longest)));
}

TEST(BusDatagram, NoneIsMadeThatNobodyWouldTake) {
  EXPECT_TRUE(make_datagram(0, "", {}).empty());
  EXPECT_TRUE(make_datagram(0, "A B", {}).empty());
  EXPECT_TRUE(make_datagram(0, std::string(64, 'A'), {}).empty());
  const std::vector<std::uint8_t> most(kLargestDatagram - 8 - 2);
  EXPECT_EQ(make_datagram(0, "A", most).size(), kLargestDatagram);
  EXPECT_TRUE(make_datagram(0, "AB", most).empty());
}

}  // namespace
}  // namespace ols
