#include "console/handed_over_socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <systemd/sd-daemon.h>

#include <array>
#include <stdexcept>

namespace ols::console {

std::optional<HandedOverSocket> handed_over_socket() {
  if (sd_listen_fds(1) < 1) return std::nullopt;
  HandedOverSocket result;
  result.descriptor = SD_LISTEN_FDS_START;
  sockaddr_storage storage{};
  socklen_t size = sizeof storage;
  auto* address = reinterpret_cast<sockaddr*>(&storage);
  if (sd_is_socket_inet(result.descriptor, AF_UNSPEC, SOCK_STREAM, 1, 0) <= 0 ||
      getsockname(result.descriptor, address, &size) != 0) {
    throw std::runtime_error("the socket that was handed over is no listening TCP socket");
  }
  std::array<char, INET6_ADDRSTRLEN> text{};
  result.is_v6 = storage.ss_family == AF_INET6;
  if (result.is_v6) {
    const auto& v6 = reinterpret_cast<const sockaddr_in6&>(storage);
    inet_ntop(AF_INET6, &v6.sin6_addr, text.data(), text.size());
    result.port = ntohs(v6.sin6_port);
  } else {
    const auto& v4 = reinterpret_cast<const sockaddr_in&>(storage);
    inet_ntop(AF_INET, &v4.sin_addr, text.data(), text.size());
    result.port = ntohs(v4.sin_port);
  }
  result.address = text.data();
  return result;
}

}  // namespace ols::console
