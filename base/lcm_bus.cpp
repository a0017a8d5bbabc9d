#include "base/lcm_bus.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>
#include <system_error>

namespace ols {
namespace {

// A datagram socket connected to the group has a route or fails at once; nothing is sent.
void require_route(const std::string& address, const std::string& port, const std::string& url) {
  std::uint16_t number = 0;
  const auto parsed = std::from_chars(port.data(), port.data() + port.size(), number);
  if (parsed.ec != std::errc() || parsed.ptr != port.data() + port.size()) {
    throw BusError(url + ": " + port + " is not a port");
  }
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(number);
  if (inet_pton(AF_INET, address.c_str(), &group.sin_addr) != 1) {
    throw BusError(url + ": " + address + " is not an IPv4 address");
  }
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) throw BusError(url + ": " + std::strerror(errno));
  const int failed = connect(descriptor, reinterpret_cast<sockaddr*>(&group), sizeof group);
  const int reason = errno;
  close(descriptor);
  if (failed != 0) {
    throw BusError(url + ": no route for multicast (" + std::strerror(reason) +
                   "); bring the interface up, or on one host: ip link set lo multicast on; "
                   "ip route add 224.0.0.0/4 dev lo");
  }
}

// Of "udpm://ADDRESS:PORT?options"; what is left out is LCM's default.
std::string checked(const std::string& url) {
  constexpr std::string_view kMulticast = "udpm://";
  if (!url.starts_with(kMulticast)) return url;
  const std::string place = url.substr(kMulticast.size(), url.find('?') - kMulticast.size());
  const std::size_t colon = place.find(':');
  const std::string address = place.substr(0, colon);
  const std::string port = colon == std::string::npos ? "" : place.substr(colon + 1);
  require_route(address.empty() ? "239.255.76.67" : address, port.empty() ? "7667" : port, url);
  return url;
}

}  // namespace

struct LcmBus::Subscriber {
  Handler handler;
  void receive(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    handler(channel, buffer->data, static_cast<int>(buffer->data_size));
  }
};

LcmBus::LcmBus(const std::string& url) : lcm_(checked(url)) {
  if (!lcm_.good()) throw BusError(url + ": LCM cannot use this URL");
}

LcmBus::~LcmBus() = default;

void LcmBus::subscribe(const std::string& channel_regex, Handler handler, int queue_capacity) {
  subscribers_.push_back(std::make_unique<Subscriber>(Subscriber{std::move(handler)}));
  auto* subscription =
      lcm_.subscribe(channel_regex, &Subscriber::receive, subscribers_.back().get());
  subscription->setQueueCapacity(queue_capacity);
}

int LcmBus::handle(int timeout_ms) {
  int handled = 0;
  while (lcm_.handleTimeout(handled == 0 ? timeout_ms : 0) > 0) ++handled;
  return handled;
}

}  // namespace ols
