#include "base/net/ip_endpoint.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ols {
namespace {

using boost::asio::ip::make_address;

TEST(IpEndpoint, AnAddressAndAPort) {
  EXPECT_EQ(parse_endpoint("10.0.0.11:7790").address(), make_address("10.0.0.11"));
  EXPECT_EQ(parse_endpoint("10.0.0.11:7790").port(), 7790);
  EXPECT_EQ(parse_endpoint("[fd00::11]:80").address(), make_address("fd00::11"));
}

TEST(IpEndpoint, AnythingElseIsRefusedInWords) {
  for (const char* bad :
       {"", "7790", "10.0.0.11", "10.0.0.11:", "10.0.0.11:0", "10.0.0.11:65536", "10.0.0.11:77x",
        "fd00::11:80", "[10.0.0.11]:80", "alfa:80", "0.0.0.0:80", "[::]:80", ":80", "[]:80"}) {
    EXPECT_THROW(parse_endpoint(bad), std::invalid_argument) << bad;
  }
}

}  // namespace
}  // namespace ols
