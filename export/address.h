// The destination of an output, as the configuration writes it. Pure.
#pragma once

#include <string>

namespace ols::exports {

enum class Scheme { kUdp, kTcp, kTls, kMqtt, kMqtts, kFile };

struct Address {
  Scheme scheme = Scheme::kUdp;
  std::string host;  // udp: an IP address; otherwise a name or an address
  int port = 0;
  std::string path;       // file
  int ttl = 1;            // udp, multicast: maximum hops of a datagram
  std::string interface;  // udp, multicast: address of the interface to send from; empty: the
                          // system's routes decide
};

// "udp://239.2.3.1:6969?ttl=1&interface=10.0.0.5", "tcp://HOST:PORT", "tls://HOST:PORT",
// "mqtt://HOST[:1883]", "mqtts://HOST[:8883]", "file:///PATH". An IPv6 address is written in
// brackets. Throws std::invalid_argument.
Address parse_address(const std::string& text);
const char* to_string(Scheme scheme);

}  // namespace ols::exports
