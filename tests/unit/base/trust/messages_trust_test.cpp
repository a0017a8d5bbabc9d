#include "base/trust/messages_trust.h"

#include <gtest/gtest.h>

#include <vector>

#include "ols_msg/ptu_command_t.hpp"
#include "tests/unit/on_the_bus.h"

namespace ols::trust {
namespace {

TEST(MessagesTrust, TheTextIsReadBack) {
  const auto bytes = encoded(to_message("a = 1\n", 2, 3, 4));
  EXPECT_EQ(list_from(bytes), "a = 1\n");
  const auto settings = encoded(to_settings_message("b = 1\n", 2, 3, 4));
  EXPECT_EQ(settings_from(settings), "b = 1\n");
}

TEST(MessagesTrust, AnythingElseIsNone) {
  auto bytes = encoded(to_message("a = 1\n", 2, 3, 4));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(list_from(Bytes(bytes).first(size))) << size;
  }
  bytes.push_back(0);
  EXPECT_FALSE(list_from(bytes));
  auto other = to_message("", 2, 3, 4);
  other.schema_version = 2;
  EXPECT_FALSE(list_from(encoded(other)));
}

TEST(MessagesTrust, AStopIsToldFromOtherOrdersWhateverElseItSays) {
  ols_msg::ptu_command_t order{};
  order.command = ols_msg::ptu_command_t::COMMAND_STOP;
  order.schema_version = 99;
  EXPECT_TRUE(is_stop(encoded(order)));
  EXPECT_FALSE(is_stop(Bytes(encoded(order)).first(20)));
  order.command = ols_msg::ptu_command_t::COMMAND_RATE;
  EXPECT_FALSE(is_stop(encoded(order)));
}

}  // namespace
}  // namespace ols::trust
