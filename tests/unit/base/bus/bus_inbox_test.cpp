#include "base/bus/bus_inbox.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace ols {
namespace {

using testing::ElementsAre;

class Inbox : public testing::Test {
 protected:
  void put(const std::string& channel, const std::string& payload = "") {
    const std::vector<std::uint8_t> bytes(payload.begin(), payload.end());
    inbox_.put(make_datagram(0, channel, bytes), 7);
  }
  void subscribe(const std::string& regex, QueueLimits limits = {},
                 BusInbox::Express express = {}) {
    inbox_.subscribe(
        regex,
        [this, regex](const BusMessage& message) {
          heard_.push_back(regex + ":" + message.channel + ":" +
                           std::string(message.payload.begin(), message.payload.end()));
        },
        limits, std::move(express));
  }
  std::vector<std::string> handle_all() {
    while (inbox_.handle_one(0)) {
    }
    return std::exchange(heard_, {});
  }

  BusInbox inbox_;
  std::vector<std::string> heard_;
};

TEST_F(Inbox, HandsOverInTheOrderOfArrivalAcrossSubscriptions) {
  subscribe("A");
  subscribe("B.*");
  for (const char* channel : {"B1", "A", "C", "B2", "A"}) put(channel);
  EXPECT_THAT(handle_all(), ElementsAre("B.*:B1:", "A:A:", "B.*:B2:", "A:A:"));
}

TEST_F(Inbox, EachSubscriptionThatMatchesGetsItsOwn) {
  subscribe("A");
  subscribe(".*");
  put("A", "x");
  EXPECT_THAT(handle_all(), ElementsAre("A:A:x", ".*:A:x"));
}

TEST_F(Inbox, ANameIsMatchedWholeAndNotAsAnExpression) {
  subscribe("OLS_PTU_a");
  subscribe("OLS_(BEARING|STATUS)_.*");
  for (const char* channel : {"OLS_PTU_ab", "XOLS_PTU_a", "OLS_BEARING_a", "OLS_SLEW_a"})
    put(channel);
  EXPECT_THAT(handle_all(), ElementsAre("OLS_(BEARING|STATUS)_.*:OLS_BEARING_a:"));
  EXPECT_THROW(subscribe("("), std::invalid_argument);
}

TEST_F(Inbox, TheOldestGiveWayOfTheFloodedSubscriptionAlone) {
  subscribe("A", {.messages = 2});
  subscribe("B");
  for (const char* payload : {"1", "2", "3", "4"}) put("A", payload);
  put("B");
  EXPECT_THAT(handle_all(), ElementsAre("A:A:3", "A:A:4", "B:B:"));
  EXPECT_EQ(inbox_.traffic().overflowed, 2U);
}

TEST_F(Inbox, BytesAreBoundedToo) {
  subscribe("A", {.messages = 1000, .bytes = 3000});
  for (int i = 0; i < 10; ++i) put("A", std::string(1000, 'x'));
  EXPECT_EQ(handle_all().size(), 2U);
  for (int i = 0; i < 10; ++i) put("A");  // what carries nothing costs memory, too
  EXPECT_EQ(handle_all().size(), 10U);
  for (int i = 0; i < 1000; ++i) put("A");
  EXPECT_LT(handle_all().size(), 20U);
}

TEST_F(Inbox, TheExpressNeverWaitsInTheQueue) {
  int stops = 0;
  subscribe("A", {.messages = 3}, [&](const BusMessage& message) {
    stops += message.payload.size() == 4;
    return message.payload.size() == 4;
  });
  put("A", "stop");
  for (int i = 0; i < 1000; ++i) put("A", "x");
  EXPECT_EQ(stops, 1);  // before anything was handled, whatever came after it
  EXPECT_EQ(handle_all().size(), 3U);
}

TEST_F(Inbox, CountsWhatItRefuses) {
  subscribe(".*");
  const std::string fragment = "LC03" + std::string(16, '\0');
  inbox_.put({reinterpret_cast<const std::uint8_t*>(fragment.data()), fragment.size()}, 0);
  inbox_.put({}, 0);
  put("A");
  EXPECT_EQ(handle_all().size(), 1U);
  EXPECT_EQ(inbox_.traffic().fragments, 1U);
  EXPECT_EQ(inbox_.traffic().malformed, 1U);
  EXPECT_EQ(inbox_.traffic().received, 1U);
}

TEST_F(Inbox, NobodyGetsLcmsSelfTest) {
  subscribe(".*");
  put(kSelfTestChannel);
  EXPECT_TRUE(handle_all().empty());
  EXPECT_EQ(inbox_.traffic().received, 1U);
}

TEST_F(Inbox, ASignatureIsNoPartOfTheMessageAndIsKeptBesideIt) {
  const trust::SigningKey key(trust::Seed{});
  const std::vector<std::uint8_t> content{'x', 'y'};
  const auto message = trust::with_trailer(key, {}, "A", content, 0);
  BusMessage heard;
  inbox_.subscribe("A", [&heard](const BusMessage& one) { heard = one; });
  inbox_.put(make_datagram(0, "A", message), 7);
  EXPECT_TRUE(inbox_.handle_one(0));
  EXPECT_EQ(heard.payload, content);
  EXPECT_EQ(heard.trailer, std::vector<std::uint8_t>(message.begin() + 2, message.end()));
  EXPECT_TRUE(heard.addressed);
}

}  // namespace
}  // namespace ols
