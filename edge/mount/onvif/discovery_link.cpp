#include "edge/mount/onvif/discovery_link.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <sodium.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <system_error>

#include "base/process/clocks.h"

namespace ols::onvif {
namespace {

constexpr const char* kGroup = "239.255.255.250";
constexpr std::uint16_t kPort = 3702;
constexpr double kAgain_s = 0.5;  // asked once more, because a datagram may be lost
constexpr std::size_t kLargestDatagram = 65536;

std::system_error failed(const char* what) {
  return {errno, std::generic_category(), std::string("discovery of cameras: ") + what};
}

struct Socket {
  Socket() : number(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    if (number < 0) throw failed("socket");
  }
  ~Socket() { ::close(number); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int number;
};

// One address of each network that can be asked.
std::vector<in_addr> own_addresses() {
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) throw failed("getifaddrs");
  const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> owned(all, ::freeifaddrs);
  std::vector<in_addr> found;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    constexpr unsigned kNeeded = IFF_UP | IFF_MULTICAST;
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET ||
        (one->ifa_flags & kNeeded) != kNeeded)
      continue;
    found.push_back(reinterpret_cast<const sockaddr_in*>(one->ifa_addr)->sin_addr);
  }
  return found;
}

void ask(const Socket& socket, const std::string& text) {
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(kPort);
  ::inet_pton(AF_INET, kGroup, &group.sin_addr);
  std::size_t asked = 0;
  for (const in_addr& address : own_addresses()) {
    if (::setsockopt(socket.number, IPPROTO_IP, IP_MULTICAST_IF, &address, sizeof address) != 0)
      continue;
    const auto sent = ::sendto(socket.number, text.data(), text.size(), 0,
                               reinterpret_cast<const sockaddr*>(&group), sizeof group);
    asked += sent >= 0 ? 1 : 0;
  }
  if (asked == 0) throw failed("no network can be asked");
}

void receive(const Socket& socket, Discovery& discovery) {
  std::string datagram(kLargestDatagram, '\0');
  for (;;) {
    sockaddr_in sender{};
    socklen_t size = sizeof sender;
    const auto length = ::recvfrom(socket.number, datagram.data(), datagram.size(), 0,
                                   reinterpret_cast<sockaddr*>(&sender), &size);
    if (length < 0) return;
    std::array<char, INET_ADDRSTRLEN> text{};
    ::inet_ntop(AF_INET, &sender.sin_addr, text.data(), text.size());
    discovery.add(datagram.substr(0, static_cast<std::size_t>(length)), text.data());
  }
}

std::string new_message_id() {
  std::array<unsigned char, 16> bytes{};
  randombytes_buf(bytes.data(), bytes.size());
  std::array<char, 2 * bytes.size() + 1> hex{};
  sodium_bin2hex(hex.data(), hex.size(), bytes.data(), bytes.size());
  std::string id(hex.data());
  id[12] = '4', id[16] = '8';  // version and variant of a random UUID (RFC 9562)
  for (const std::size_t dash : {8, 13, 18, 23}) id.insert(dash, 1, '-');
  return "urn:uuid:" + id;
}

}  // namespace

Discovery look_for_cameras(double seconds) {
  const std::string id = new_message_id();
  const Socket socket;
  Discovery discovery(id);
  const double began_s = clock_monotonic_s();
  int asked = 0;
  for (double passed_s = 0.0; passed_s < seconds; passed_s = clock_monotonic_s() - began_s) {
    if (passed_s >= asked * kAgain_s && asked < 2) {
      ask(socket, probe(id));
      ++asked;
    }
    const double until_s = asked < 2 ? std::min(seconds, asked * kAgain_s) : seconds;
    pollfd ready{socket.number, POLLIN, 0};
    if (::poll(&ready, 1, static_cast<int>(1e3 * (until_s - passed_s)) + 1) > 0)
      receive(socket, discovery);
  }
  return discovery;
}

}  // namespace ols::onvif
