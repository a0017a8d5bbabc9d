#include "export/outlet/tcp_socket.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

#include "export/outlet/link.h"

namespace ols::exports {
namespace {

constexpr int kMostUnsentBytes = 16'384;

using Addresses = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;

Addresses look_up(const std::string& host, int port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int bad = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (bad != 0) throw LinkError(host + ": " + ::gai_strerror(bad));
  return {found, ::freeaddrinfo};
}

}  // namespace

void keep_unsent_short(int descriptor) {
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &kMostUnsentBytes,
               sizeof kMostUnsentBytes);
}

// A name may have several addresses, of which only some are reachable from here.
TcpSocket::TcpSocket(const std::string& host, int port, double patience_s) {
  const Addresses addresses = look_up(host, port);
  int count = 0, error = 0;
  for (const addrinfo* to = addresses.get(); to != nullptr; to = to->ai_next) ++count;
  for (const addrinfo* to = addresses.get(); to != nullptr; to = to->ai_next) {
    error = connect(*to, patience_s / count);
    if (error == 0) return;
  }
  throw LinkError(host + ":" + std::to_string(port) + ": " + std::strerror(error));
}

// 0, or why not (errno).
int TcpSocket::connect(const addrinfo& to, double patience_s) {
  fd_ = ::socket(to.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd_ < 0) return errno;
  const int yes = 1;
  ::setsockopt(fd_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  keep_unsent_short(fd_);
  int error = ::connect(fd_, to.ai_addr, to.ai_addrlen) == 0 ? 0 : errno;
  if (error == EINPROGRESS) {
    socklen_t size = sizeof error;
    error = wait(true, patience_s) ? 0 : ETIMEDOUT;
    if (error == 0) ::getsockopt(fd_, SOL_SOCKET, SO_ERROR, &error, &size);
  }
  if (error != 0) ::close(fd_);
  return error;
}

TcpSocket::~TcpSocket() { ::close(fd_); }

bool TcpSocket::wait(bool to_write, double patience_s) const {
  pollfd ready{fd_, static_cast<short>(to_write ? POLLOUT : POLLIN), 0};
  int found = 0;
  do {
    found = ::poll(&ready, 1, static_cast<int>(1e3 * patience_s));
  } while (found < 0 && errno == EINTR);
  return found > 0;
}

}  // namespace ols::exports
