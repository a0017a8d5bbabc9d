#include "base/lcm_bus.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "base/lcm_url.h"

namespace ols {
namespace {

// A datagram socket connected to the group has a route or fails at once; nothing is sent.
void require_route(const sockaddr_in& group, const std::string& url) {
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) throw BusError(url + ": " + std::strerror(errno));
  const int failed = connect(descriptor, reinterpret_cast<const sockaddr*>(&group), sizeof group);
  const int reason = errno;
  close(descriptor);
  if (failed != 0) {
    throw BusError(url + ": no route for multicast (" + std::strerror(reason) +
                   "); bring the interface up, or on one host: ip link set lo multicast on; "
                   "ip route add 224.0.0.0/4 dev lo");
  }
}

std::string checked(const std::string& url) {
  try {
    if (const auto group = multicast_group(url)) require_route(*group, url);
  } catch (const std::invalid_argument& problem) {
    throw BusError(problem.what());
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

// Where the test fails (a firewall), LCM hands out subscriptions that crash when they are touched.
void LcmBus::listen() {
  if (lcm_.getFileno() >= 0) return;
  throw BusError(
      "nothing comes back on this host's bus; a firewall, or a service's address filter?");
}

void LcmBus::subscribe(const std::string& channel_regex, Handler handler, int queue_capacity) {
  listen();
  subscribers_.push_back(std::make_unique<Subscriber>(Subscriber{std::move(handler)}));
  auto* subscription =
      lcm_.subscribe(channel_regex, &Subscriber::receive, subscribers_.back().get());
  subscription->setQueueCapacity(queue_capacity);
}

int LcmBus::handle(int timeout_ms) {
  int handled = 0;
  constexpr int kMost = 256;
  while (handled < kMost && lcm_.handleTimeout(handled == 0 ? timeout_ms : 0) > 0) ++handled;
  return handled;
}

}  // namespace ols
