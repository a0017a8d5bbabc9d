#include "base/bus/multicast_socket.h"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace ols {
namespace {

int checked(int result, const char* what) {
  if (result >= 0) return result;
  throw std::system_error(errno, std::generic_category(), what);
}

template <class Value>
void set_option(int socket, int level, int name, const Value& value, const char* what) {
  checked(::setsockopt(socket, level, name, &value, sizeof value), what);
}

const sockaddr* as_address(const sockaddr_in& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

}  // namespace

// Connecting a datagram socket sends nothing; it fails where there is no route.
MulticastSocket::MulticastSocket(const BusAddress& address) : address_(address) {
  sending_ = checked(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0), "socket");
  try {
    const auto ttl = static_cast<unsigned char>(address.ttl);
    set_option(sending_, IPPROTO_IP, IP_MULTICAST_TTL, ttl, "IP_MULTICAST_TTL");
    checked(::connect(sending_, as_address(*address_.group), sizeof(sockaddr_in)), "no route");
  } catch (...) {
    ::close(sending_);
    throw;
  }
}

MulticastSocket::~MulticastSocket() {
  ::close(sending_);
  if (receiving_ >= 0) ::close(receiving_);
}

// Bound to the group's address, so that unicast datagrams are not received.
void MulticastSocket::listen() {
  if (receiving_ >= 0) return;
  const int fresh =
      checked(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0), "socket");
  try {
    set_option(fresh, SOL_SOCKET, SO_REUSEADDR, 1, "SO_REUSEADDR");
    // The kernel limits it to net.core.rmem_max.
    const int bytes = address_.receive_buffer_bytes;
    set_option(fresh, SOL_SOCKET, SO_RCVBUF, bytes, "SO_RCVBUF");
    set_option(fresh, SOL_SOCKET, SO_RXQ_OVFL, 1, "SO_RXQ_OVFL");
    checked(::bind(fresh, as_address(*address_.group), sizeof(sockaddr_in)), "bind");
    ip_mreq membership{};
    membership.imr_multiaddr = address_.group->sin_addr;
    membership.imr_interface.s_addr = htonl(INADDR_ANY);
    set_option(fresh, IPPROTO_IP, IP_ADD_MEMBERSHIP, membership, "IP_ADD_MEMBERSHIP");
  } catch (...) {
    ::close(fresh);
    throw;
  }
  receiving_ = fresh;
}

std::optional<std::span<const std::uint8_t>> MulticastSocket::receive(
    std::span<std::uint8_t> buffer) {
  iovec room{buffer.data(), buffer.size()};
  alignas(cmsghdr) std::array<std::uint8_t, CMSG_SPACE(sizeof(std::uint32_t))> control{};
  msghdr message{};
  message.msg_iov = &room;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t bytes = ::recvmsg(receiving_, &message, 0);
  if (bytes < 0) return std::nullopt;
  count_dropped(message);
  return buffer.first(static_cast<std::size_t>(bytes));
}

// Once it has dropped a datagram, the kernel reports its count with each one.
void MulticastSocket::count_dropped(msghdr& message) {
  const cmsghdr* told = CMSG_FIRSTHDR(&message);
  if (told == nullptr || told->cmsg_level != SOL_SOCKET || told->cmsg_type != SO_RXQ_OVFL) return;
  std::uint32_t count = 0;
  std::memcpy(&count, CMSG_DATA(told), sizeof count);
  dropped_ += static_cast<std::uint32_t>(count - kernels_count_);
  kernels_count_ = count;
}

std::error_code MulticastSocket::send(std::span<const std::uint8_t> datagram) {
  while (::send(sending_, datagram.data(), datagram.size(), 0) < 0) {
    if (errno != EINTR) return {errno, std::generic_category()};
  }
  return {};
}

}  // namespace ols
