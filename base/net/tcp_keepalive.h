// Keepalive of a TCP connection. A peer that has lost power falls silent without closing the
// connection. With keepalive, the kernel probes a silent peer, and closes the connection if the
// peer does not answer.
#pragma once

namespace ols {

struct TcpKeepalive {
  int idle_s = 0;      // silence before the first probe
  int interval_s = 0;  // time between two probes
  int probes = 0;      // after this many unanswered probes, the connection is closed
};

void keep_alive(int socket, const TcpKeepalive& keepalive);

}  // namespace ols
