#include "base/lcm_bus.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <regex>

namespace ols {
namespace {

// A datagram socket connected to the group has a route or fails at once; nothing is sent.
void require_route(const std::string& address, const std::string& port, const std::string& url) {
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(static_cast<std::uint16_t>(std::stoi(port)));
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

std::string checked(const std::string& url) {
  static const std::regex udpm("udpm://([0-9.]*):?([0-9]{1,5})?(\\?.*)?");
  std::smatch parts;
  if (std::regex_match(url, parts, udpm)) {
    const std::string address = parts[1].length() > 0 ? parts[1].str() : "239.255.76.67";
    require_route(address, parts[2].matched ? parts[2].str() : "7667", url);
  }
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
