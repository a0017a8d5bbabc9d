#include "base/lcm_url.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace ols {
namespace {

TEST(LcmUrl, FillsInLcmsDefaults) {
  const auto group = multicast_group("udpm://");
  ASSERT_TRUE(group);
  EXPECT_EQ(ntohs(group->sin_port), 7667);
  EXPECT_EQ(group->sin_addr.s_addr, inet_addr("239.255.76.67"));
  EXPECT_EQ(ntohs(multicast_group("udpm://:7700?ttl=1")->sin_port), 7700);
  EXPECT_EQ(multicast_group("udpm://239.1.2.3:1?ttl=0")->sin_addr.s_addr, inet_addr("239.1.2.3"));
}

TEST(LcmUrl, LeavesOtherKindsToLcm) {
  EXPECT_FALSE(multicast_group("memq://"));
  EXPECT_FALSE(multicast_group("tcpq://host:7700"));
}

TEST(LcmUrl, RefusesWhatIsNone) {
  for (const char* url : {"", "bogus://x", "udpm://300.1.1.1:99", "udpm://239.1.2.3:99999",
                          "udpm://239.1.2.3:", "udpm://127.0.0.1:7667", "239.255.76.67:7667"}) {
    EXPECT_THROW(multicast_group(url), std::invalid_argument) << url;
  }
}

TEST(LcmUrl, TheConfigurationNamesTheKey) {
  ConfigFile file("lcm_url = 'bogus://x'\n", "s.toml");
  try {
    read_lcm_url(file.root(), "lcm_url", "memq://");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_EQ(std::string(error.what()).find("s.toml:1: lcm_url: "), 0u) << error.what();
  }
}

}  // namespace
}  // namespace ols
