#include "base/bus/lcm_url.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "tests/unit/temp_dir.h"

namespace ols {
namespace {

TEST(LcmUrl, FillsInLcmsDefaults) {
  const auto group = parse_lcm_url("udpm://").group;
  ASSERT_TRUE(group);
  EXPECT_EQ(ntohs(group->sin_port), 7667);
  EXPECT_EQ(group->sin_addr.s_addr, inet_addr("239.255.76.67"));
  EXPECT_EQ(ntohs(parse_lcm_url("udpm://:7700?ttl=1").group->sin_port), 7700);
  EXPECT_EQ(parse_lcm_url("udpm://239.1.2.3:1?ttl=0").group->sin_addr.s_addr,
            inet_addr("239.1.2.3"));
}

TEST(LcmUrl, HasOptions) {
  EXPECT_EQ(parse_lcm_url("udpm://").ttl, 0);
  EXPECT_EQ(parse_lcm_url("udpm://239.1.2.3:1?ttl=1").ttl, 1);
  const BusAddress both = parse_lcm_url("udpm://?recv_buf_size=9&ttl=255");
  EXPECT_EQ(both.ttl, 255);
  EXPECT_EQ(both.receive_buffer_bytes, 9);
}

TEST(LcmUrl, ABusWithinTheProcessHasNoGroup) {
  EXPECT_FALSE(parse_lcm_url("memq://").group);
  EXPECT_EQ(parse_lcm_url("memq://").name, "");
  EXPECT_EQ(parse_lcm_url("memq://site").name, "site");
}

TEST(LcmUrl, TheDefaultLeavesAHostOfASiteOnly) {
  const std::string bus_env = temp_dir() + "bus.env";
  EXPECT_EQ(parse_lcm_url(default_lcm_url(bus_env)).ttl, 0);
  std::ofstream(bus_env) << "OLS_BUS_INTERFACE=eth0\n";
  EXPECT_EQ(parse_lcm_url(default_lcm_url(bus_env)).ttl, 1);
}

TEST(LcmUrl, RefusesWhatIsNone) {
  for (const char* url :
       {"", "bogus://x", "udpm://300.1.1.1:99", "udpm://239.1.2.3:99999",
        "udpm://239.1.2.3:", "udpm://127.0.0.1:7667", "239.255.76.67:7667", "tcpq://host:7700",
        "udpm://239.1.2.3:1?ttl=x", "udpm://239.1.2.3:1?ttl=256", "udpm://239.1.2.3:1?ttl",
        "udpm://239.1.2.3:1?time=1"}) {
    EXPECT_THROW(parse_lcm_url(url), std::invalid_argument) << url;
  }
}

}  // namespace
}  // namespace ols
