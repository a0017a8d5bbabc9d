// The address of a bus, in LCM's notation. udpm://ADDRESS:PORT?ttl=N is a multicast group.
// memq://NAME is a bus within one process, which all connections to that name share. memq:// is a
// bus of one connection alone. LCM's other kinds (tcpq, file, mpudpm) are not supported.
#pragma once

#include <netinet/in.h>

#include <optional>
#include <string>

namespace ols {

struct BusAddress {
  std::optional<sockaddr_in> group;      // nullopt: within this process
  std::string name;                      // of a memq:// bus; empty: a bus of this connection alone
  int ttl = 0;                           // maximum hops of a datagram; 0: it does not leave this
                                         // host
  int receive_buffer_bytes = 8'388'608;  // as requested; the kernel grants at most
                                         // net.core.rmem_max
};

// Parts that are missing get LCM's defaults: 239.255.76.67, 7667, ttl=0. Throws
// std::invalid_argument that says what is wrong.
BusAddress parse_lcm_url(const std::string& url);
// What is wrong with the URL; empty: nothing. For the command line.
std::string lcm_url_problem(const std::string& url);

// The URL for programs without a configuration. The hosts of a site have the file `bus_env`, which
// tells ols-bus.service the network interface of the bus. If this host has the file, the bus of the
// URL reaches the other hosts; otherwise the bus stays on this host.
std::string default_lcm_url(const std::string& bus_env = "/etc/ols/bus.env");

}  // namespace ols
