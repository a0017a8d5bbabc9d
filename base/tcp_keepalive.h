// A peer that has lost its power says nothing any more: the kernel asks it from time to time, and
// ends the connection when it does not answer.
#pragma once

namespace ols {

struct TcpKeepalive {
  int idle_s = 0;      // of silence, until the first question
  int interval_s = 0;  // between two questions
  int probes = 0;      // so many without an answer end the connection
};

void keep_alive(int socket, const TcpKeepalive& keepalive);

}  // namespace ols
