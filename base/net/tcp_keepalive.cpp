#include "base/net/tcp_keepalive.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

namespace ols {

void keep_alive(int socket, const TcpKeepalive& keepalive) {
  const auto set = [socket](int level, int name, int value) {
    ::setsockopt(socket, level, name, &value, sizeof value);
  };
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, keepalive.idle_s);
  set(IPPROTO_TCP, TCP_KEEPINTVL, keepalive.interval_s);
  set(IPPROTO_TCP, TCP_KEEPCNT, keepalive.probes);
}

}  // namespace ols
