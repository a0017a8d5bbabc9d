#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>

#include "base/net/ip_endpoint.h"
#include "base/net/ip_networks.h"
#include "base/net/length_prefix.h"
#include "base/net/tcp_keepalive.h"

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

TEST(LengthPrefix, MostSignificantByteFirst) {
  EXPECT_EQ(length_prefix(0x01020304), (LengthPrefix{1, 2, 3, 4}));
  EXPECT_EQ(message_length({1, 2, 3, 4}, 0x01020304), 0x01020304U);
}

TEST(LengthPrefix, EmptyOrTooLongIsNoMessage) {
  EXPECT_EQ(message_length({0, 0, 0, 0}, 100), std::nullopt);
  EXPECT_EQ(message_length({0, 0, 0, 100}, 100), 100U);
  EXPECT_EQ(message_length({0, 0, 0, 101}, 100), std::nullopt);
  EXPECT_EQ(message_length({0xff, 0xff, 0xff, 0xff}, 100), std::nullopt);
}

TEST(TcpKeepalive, TheKernelAsksAsOftenAsTold) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  ASSERT_GE(socket, 0);
  const auto option = [socket](int level, int name) {
    int value = -1;
    socklen_t size = sizeof value;
    ::getsockopt(socket, level, name, &value, &size);
    return value;
  };
  EXPECT_EQ(option(SOL_SOCKET, SO_KEEPALIVE), 0);
  keep_alive(socket, {.idle_s = 2, .interval_s = 1, .probes = 4});
  EXPECT_EQ(option(SOL_SOCKET, SO_KEEPALIVE), 1);
  EXPECT_EQ(option(IPPROTO_TCP, TCP_KEEPIDLE), 2);
  EXPECT_EQ(option(IPPROTO_TCP, TCP_KEEPINTVL), 1);
  EXPECT_EQ(option(IPPROTO_TCP, TCP_KEEPCNT), 4);
  ::close(socket);
}

}  // namespace
}  // namespace ols
