// Keepalive of a connection. A peer that has lost its power sends nothing any more; the kernel
// probes it, and closes the connection if it does not answer.
#pragma once

namespace ols {

struct TcpKeepalive {
  int idle_s = 0;      // silence before the first probe
  int interval_s = 0;  // between two probes
  int probes = 0;      // the connection is closed after this many unanswered probes
};

void keep_alive(int socket, const TcpKeepalive& keepalive);

}  // namespace ols
