// The address of a bus, in LCM's notation: udpm://ADDRESS:PORT?ttl=N, or within one process memq://
// (this connection alone) or memq://NAME (all connections with that name). LCM's other kinds (tcpq,
// file, mpudpm) are not supported.
#pragma once

#include <netinet/in.h>

#include <optional>
#include <string>

namespace ols {

struct BusAddress {
  std::optional<sockaddr_in> group;      // nullopt: within this process
  std::string name;                      // of the bus within this process; empty: one connection
  int ttl = 0;                           // hops; 0: it does not leave this host
  int receive_buffer_bytes = 8'388'608;  // requested; the kernel grants at most net.core.rmem_max
};

// LCM's defaults are 239.255.76.67, 7667, ttl=0. Throws std::invalid_argument with the error.
BusAddress parse_lcm_url(const std::string& url);
// What is wrong with the URL; empty: nothing. For the command line.
std::string lcm_url_problem(const std::string& url);

// The default for programs without a configuration. If the file `bus_env` exists
// (OLS_BUS_INTERFACE: ols-bus.service), this is a host of a site, and its bus reaches the other
// hosts. Otherwise the bus stays on this host.
std::string default_lcm_url(const std::string& bus_env = "/etc/ols/bus.env");

}  // namespace ols
