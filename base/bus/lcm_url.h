// The address of a bus, in LCM's notation. udpm://ADDRESS:PORT?ttl=N is a multicast group. Within
// one process, memq://NAME joins all connections with that name, and memq:// is a bus of one
// connection. LCM's other kinds (tcpq, file, mpudpm) are not supported.
#pragma once

#include <netinet/in.h>

#include <optional>
#include <string>

namespace ols {

struct BusAddress {
  std::optional<sockaddr_in> group;      // nullopt: within this process
  std::string name;                      // of a memq:// bus; empty: this connection alone
  int ttl = 0;                           // hops; 0: it does not leave this host
  int receive_buffer_bytes = 8'388'608;  // requested; the kernel grants at most net.core.rmem_max
};

// LCM's defaults are 239.255.76.67, 7667, ttl=0. Throws std::invalid_argument with the error.
BusAddress parse_lcm_url(const std::string& url);
// The error in the URL; empty: it is valid. For the command line.
std::string lcm_url_problem(const std::string& url);

// The bus of programs without a configuration. Only the hosts of a site have the file `bus_env`,
// which names the network interface of the bus for ols-bus.service. With the file, the bus reaches
// the other hosts; without it, the bus stays on this host.
std::string default_lcm_url(const std::string& bus_env = "/etc/ols/bus.env");

}  // namespace ols
