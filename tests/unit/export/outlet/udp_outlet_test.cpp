#include "export/outlet/udp_outlet.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

namespace ols::exports {
namespace {

// Bound to a port of this host: to `port`, or to any if that is 0.
int bound(int& port) {
  const int receiver = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  here.sin_port = htons(static_cast<std::uint16_t>(port));
  socklen_t size = sizeof here;
  auto* const name = reinterpret_cast<sockaddr*>(&here);
  EXPECT_EQ(::bind(receiver, name, size), 0);
  EXPECT_EQ(::getsockname(receiver, name, &size), 0);
  port = ntohs(here.sin_port);
  return receiver;
}

TEST(UdpOutlet, WhoDoesNotListenIsSaidAllTheTimeAndGetsTheFirstDatagramWhenItDoes) {
  Address address;
  address.scheme = Scheme::kUdp;
  address.host = std::string("127.0.0.1");
  ::close(bound(address.port));
  UdpOutlet outlet(address);
  outlet.put({{"target", "unheard"}});
  for (int i = 0; i < 6; ++i) {
    outlet.put({{"target", "unheard"}});
    EXPECT_EQ(outlet.report().trouble, "nobody listens there");
  }
  const int receiver = bound(address.port);
  outlet.put({{"target", "heard"}});
  char text[16] = {};
  EXPECT_EQ(::recv(receiver, text, sizeof text, MSG_DONTWAIT), 5);
  EXPECT_STREQ(text, "heard");
  ::close(receiver);
}

}  // namespace
}  // namespace ols::exports
