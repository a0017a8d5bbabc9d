#include "base/net/ip_networks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace ols {
namespace {

using boost::asio::ip::make_address;

TEST(IpNetworks, OnlyTheNetworksThatAreNamed) {
  const IpNetworks networks({"10.0.7.0/24", "192.168.1.5/32", "fd00:7::/32"});
  for (const char* friendly :
       {"10.0.7.1", "10.0.7.255", "192.168.1.5", "fd00:7:1::9", "::ffff:10.0.7.9"}) {
    EXPECT_TRUE(networks.contain(make_address(friendly))) << friendly;
  }
  for (const char* stranger : {"10.0.8.1", "192.168.1.4", "fd00:8::1", "::1", "::ffff:10.0.8.9"}) {
    EXPECT_FALSE(networks.contain(make_address(stranger))) << stranger;
  }
}

TEST(IpNetworks, WithoutNetworksNobody) {
  EXPECT_FALSE(IpNetworks({}).contain(make_address("127.0.0.1")));
}

TEST(IpNetworks, WhatIsNoNetworkIsNamed) {
  for (const char* bad : {"10.0.0.0", "10.0.0.0/33", "fd00::/129", "x/8", ""}) {
    EXPECT_THROW(IpNetworks({bad}), std::invalid_argument) << bad;
  }
}

}  // namespace
}  // namespace ols
