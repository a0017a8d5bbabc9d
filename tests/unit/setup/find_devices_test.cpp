#include "tools/setup/find_devices.h"

#include <gtest/gtest.h>

namespace ols::setup {
namespace {

TEST(FindDevices, AReceiverIsKnownByASentenceOrAFrame) {
  EXPECT_TRUE(is_receiver_talk("7,,*5E\r\n$GPRMC,120000.00,A*5A\r\n"));
  EXPECT_TRUE(is_receiver_talk("$GNGGA,1,2,3*7F\r\n"));
  EXPECT_TRUE(is_receiver_talk(std::string("x\xb5\x62\x01\x07", 5)));
}

TEST(FindDevices, OtherTalkIsNot) {
  for (const char* other : {"", "* PTU-D46 v2.12.1\r\n", "$GPRMC,12", "$XXRMC,1*00\r\n",
                            "GPRMC,1*00\r\n", "$GPRMC,\x01*00\r\n"}) {
    EXPECT_FALSE(is_receiver_talk(other)) << other;
  }
}

TEST(FindDevices, ALineThatIsNotThereIsNoDevice) {
  EXPECT_TRUE(find_ptus({"/nonexistent/line"}).empty());
  EXPECT_TRUE(find_receivers({"/nonexistent/line"}).empty());
}

}  // namespace
}  // namespace ols::setup
