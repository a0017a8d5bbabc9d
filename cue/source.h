// Where an input comes from, as the configuration states it. Pure.
#pragma once

#include <string>

namespace ols::cues {

enum class Carrier { kUdp, kTcp, kFile, kHttp };

struct Source {
  Carrier carrier = Carrier::kUdp;
  std::string host;  // udp: the address to listen on, or a group; tcp, http: the server
  int port = 0;
  std::string path;       // path of a file, on this host or on a web server
  std::string interface;  // udp, multicast group: address of the network interface to listen on;
                          // empty: any
};

// "udp://239.2.3.1:6969?interface=10.0.0.5", "udp://0.0.0.0:6969", "tcp://HOST:PORT",
// "file:///PATH", "http://HOST[:80]/PATH". Throws std::invalid_argument.
Source parse_source(const std::string& text);

}  // namespace ols::cues
