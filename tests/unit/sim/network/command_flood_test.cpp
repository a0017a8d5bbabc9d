#include "sim/network/command_flood.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "ols_msg/designate_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/slew_t.hpp"

namespace ols::sim {
namespace {

constexpr std::int64_t kNow_us = 1'800'000'000'000'000;
constexpr int kMany = 20000;
constexpr std::int8_t kPoint = ols_msg::ptu_command_t::COMMAND_POINT;
constexpr std::int8_t kStop = ols_msg::ptu_command_t::COMMAND_STOP;

template <class Message>
bool decodes(const Packet& packet, Message& message) {
  const int size = static_cast<int>(packet.data.size());
  return message.decode(packet.data.data(), 0, size) == size;
}

// As far as a command's own fields tell: stamp, schema, address, lease, a sender not yet used up.
template <class Message>
bool looks_valid(const Message& m) {
  const double age_s = 1e-6 * static_cast<double>(kNow_us - m.utime);
  return m.schema_version == Message::SCHEMA_VERSION && m.station == "alfa" && m.lease_s > 0.0 &&
         age_s > -0.5 && age_s < m.lease_s;
}

TEST(CommandFlood, SpeaksOnTheChannelsOfOneStation) {
  CommandFlood flood("alfa", 1);
  std::map<std::string, int> seen;
  for (int i = 0; i < kMany; ++i) ++seen[flood.next(kNow_us).channel];
  ASSERT_EQ(seen.size(), 3U);
  EXPECT_NEAR(seen.at("OLS_PTU_alfa"), kMany / 2, kMany / 20);
  EXPECT_NEAR(seen.at("OLS_SLEW_alfa"), kMany / 4, kMany / 20);
  EXPECT_NEAR(seen.at("OLS_DESIGNATE_alfa"), kMany / 4, kMany / 20);
}

TEST(CommandFlood, WhatAStationMayObeyIsAFewPointsToAndFro) {
  CommandFlood flood("alfa", 2);
  int valid = 0, damaged = 0, obeyed = 0;
  std::set<std::int64_t> senders;
  for (int i = 0; i < kMany; ++i) {
    const Packet packet = flood.next(kNow_us);
    if (packet.channel == "OLS_PTU_alfa") {
      ols_msg::ptu_command_t m;
      if (!decodes(packet, m)) {
        ++damaged;
        continue;
      }
      EXPECT_NE(m.command, kStop);  // it would help the operator
      if (!looks_valid(m)) continue;
      ++valid;
      senders.insert(m.boot_id);
      EXPECT_EQ(m.command, kPoint);
      if (m.tilt_rad > 1.0) continue;
      ++obeyed;
      EXPECT_EQ(m.pan_rad, swing_goal_rad(kNow_us));
    } else if (packet.channel == "OLS_DESIGNATE_alfa") {
      ols_msg::designate_t m;
      const bool whole = decodes(packet, m);
      EXPECT_TRUE(!whole || m.x_px > 1e5);
    }
  }
  EXPECT_NEAR(obeyed, kMany / 18, kMany / 100);
  EXPECT_EQ(swing_goal_rad(kNow_us), -swing_goal_rad(kNow_us + kSwing_us));
  EXPECT_GT(damaged, kMany / 40);
  EXPECT_GT(valid, kMany / 20);
  EXPECT_GT(senders.size(), 900U);  // each from another sender: a memory of senders fills up
}

TEST(CommandFlood, SomeAreStampedAheadAndSomeSequencesAreTheGreatest) {
  CommandFlood flood("alfa", 3);
  int ahead = 0, greatest = 0;
  for (int i = 0; i < kMany; ++i) {
    const Packet packet = flood.next(kNow_us);
    ols_msg::ptu_command_t command;
    ols_msg::slew_t slew;
    if (packet.channel == "OLS_PTU_alfa" && decodes(packet, command) && looks_valid(command)) {
      ahead += command.utime > kNow_us + 400'000 ? 1 : 0;
    }
    if (packet.channel == "OLS_SLEW_alfa" && decodes(packet, slew)) {
      greatest += slew.sequence == INT64_MAX ? 1 : 0;
    }
  }
  EXPECT_GT(ahead, 500);
  EXPECT_GT(greatest, 500);
}

TEST(CommandFlood, TheSameSeedGivesTheSameMessages) {
  CommandFlood one("alfa", 4), two("alfa", 4);
  for (int i = 0; i < 1000; ++i) {
    const Packet a = one.next(kNow_us), b = two.next(kNow_us);
    EXPECT_EQ(a.channel, b.channel);
    EXPECT_EQ(a.data, b.data);
  }
}

}  // namespace
}  // namespace ols::sim
