#include "edge/gpio/line_protocol.h"

#include <gtest/gtest.h>

#include <string>

namespace ols::gpio {
namespace {

using Levels = std::vector<LineProtocol::Level>;

TEST(LineProtocol, GivesTheLevelsOfItsLines) {
  LineProtocol protocol({17, 18});
  EXPECT_EQ(protocol.receive("in 17 1\nin 3 0\nin 18 0\nin 1"), (Levels{{17, true}, {18, false}}));
  EXPECT_EQ(protocol.receive("7 0\n"), (Levels{{17, false}})) << "a line in two pieces";
  EXPECT_EQ(protocol.receive(""), Levels{});
}

TEST(LineProtocol, RefusesWhatIsNoLevel) {
  for (const char* bad : {"in 17 2\n", "in -1 1\n", "in 17\n", "out 17 1\n", "in 99999999999 1\n",
                          "\n", "in 17 1 \n"}) {
    EXPECT_EQ(LineProtocol({17}).receive(bad), std::nullopt) << bad;
  }
}

TEST(LineProtocol, ALineWithoutEndIsRefusedHoweverItComes) {
  const std::string endless = "in " + std::string(70, '0') + "17 1\n";
  EXPECT_EQ(LineProtocol({17}).receive(endless), std::nullopt);
  EXPECT_EQ(LineProtocol({17}).receive(endless.substr(0, 66)), std::nullopt);
}

}  // namespace
}  // namespace ols::gpio
