#include "sim/camera/gige_control.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace ols::sim {
namespace {

constexpr std::uint16_t kControlPort = 3956;

int control_socket(in_addr_t address, bool shared) {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) return -1;
  const int on = shared ? 1 : 0;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in local{};
  local.sin_family = AF_INET;
  local.sin_addr.s_addr = address;
  local.sin_port = htons(kControlPort);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&local), sizeof local) == 0) return fd;
  const int error = errno;
  close(fd);
  errno = error;
  return -1;
}

// The netmask of the interface that has this address.
in_addr_t network_mask(in_addr_t address) {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return INADDR_BROADCAST;
  in_addr_t found = INADDR_BROADCAST;
  for (const ifaddrs* i = list; i != nullptr; i = i->ifa_next) {
    if (i->ifa_addr == nullptr || i->ifa_addr->sa_family != AF_INET || i->ifa_netmask == nullptr)
      continue;
    const auto own = reinterpret_cast<const sockaddr_in*>(i->ifa_addr)->sin_addr.s_addr;
    const auto mask = reinterpret_cast<const sockaddr_in*>(i->ifa_netmask)->sin_addr.s_addr;
    if ((own & mask) == (address & mask)) found = mask;
  }
  freeifaddrs(list);
  return found;
}

}  // namespace

std::uint32_t camera_address(const std::string& text) {
  in_addr address{};
  if (inet_pton(AF_INET, text.c_str(), &address) != 1)
    throw std::system_error(EINVAL, std::generic_category(), "camera address " + text);
  return address.s_addr;
}

GigeControl::GigeControl(const std::string& address, Handle handle)
    : address_(camera_address(address)), mask_(network_mask(address_)), handle_(std::move(handle)) {
  const int own = control_socket(address_, false);
  if (own < 0) throw std::system_error(errno, std::generic_category(), "camera address " + address);
  sockets_.push_back(own);
  for (const in_addr_t broadcast : {in_addr_t{INADDR_BROADCAST}, address_ | ~mask_}) {
    const int fd = control_socket(broadcast, true);
    if (fd >= 0) sockets_.push_back(fd);
  }
  wake_ = eventfd(0, EFD_CLOEXEC);
  thread_ = std::thread([this] { run(); });
}

GigeControl::~GigeControl() {
  eventfd_write(wake_, 1);
  thread_.join();
  for (const int fd : sockets_) close(fd);
  close(wake_);
}

void GigeControl::run() {
  std::vector<pollfd> ready;
  for (const int fd : sockets_) ready.push_back({.fd = fd, .events = POLLIN, .revents = 0});
  ready.push_back({.fd = wake_, .events = POLLIN, .revents = 0});
  while (poll(ready.data(), ready.size(), -1) >= 0 || errno == EINTR) {
    if (ready.back().revents != 0) return;
    for (const pollfd& entry : ready)
      if (entry.revents != 0) receive(entry.fd);
  }
}

void GigeControl::receive(int fd) {
  std::array<std::uint8_t, 2048> packet{};
  sockaddr_in from{};
  socklen_t from_size = sizeof from;
  const ssize_t size =
      recvfrom(fd, packet.data(), packet.size(), 0, reinterpret_cast<sockaddr*>(&from), &from_size);
  if (size <= 0) return;
  // Packets from other networks: the host's other interfaces receive broadcasts that a camera on
  // this network would not.
  if ((from.sin_addr.s_addr & mask_) != (address_ & mask_)) return;
  const std::uint64_t peer = std::uint64_t{from.sin_addr.s_addr} << 16 | from.sin_port;
  handle_(gige::Bytes(packet).first(static_cast<std::size_t>(size)), peer,
          [&](gige::Bytes acknowledgement) {
            sendto(sockets_.front(), acknowledgement.data(), acknowledgement.size(), 0,
                   reinterpret_cast<const sockaddr*>(&from), from_size);
          });
}

}  // namespace ols::sim
