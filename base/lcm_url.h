// The address of a bus, written as LCM writes it: udpm://ADDRESS:PORT?ttl=N, or memq:// for a bus
// within one process. LCM's other kinds (tcpq, file, mpudpm) are not supported.
#pragma once

#include <netinet/in.h>

#include <optional>
#include <string>

namespace ols {

struct BusAddress {
  std::optional<sockaddr_in> group;      // nothing: within this process
  int ttl = 0;                           // hops; 0: it does not leave this host
  int receive_buffer_bytes = 8'388'608;  // asked for; the kernel gives net.core.rmem_max at most
};

// LCM's defaults filled in: 239.255.76.67, 7667, ttl=0. Throws std::invalid_argument saying what is
// wrong.
BusAddress parse_lcm_url(const std::string& url);

// Of programs that have no configuration: where `bus_env` is (OLS_BUS_INTERFACE: ols-bus.service),
// this is a host of a site, whose bus reaches the other hosts too; else the bus stays on this host.
std::string default_lcm_url(const std::string& bus_env = "/etc/ols/bus.env");

}  // namespace ols
