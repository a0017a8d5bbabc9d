#include "base/bus/lcm_bus.h"

#include <poll.h>

#include <array>
#include <cerrno>
#include <map>
#include <mutex>
#include <system_error>

#include "base/process/clocks.h"
#include "base/trust/messages_trust.h"

namespace ols {
namespace {

BusAddress address_of(const std::string& url) {
  try {
    return parse_lcm_url(url);
  } catch (const std::invalid_argument& problem) {
    throw BusError(problem.what());
  }
}

std::unique_ptr<MulticastSocket> open_socket(const std::string& url) {
  const BusAddress address = address_of(url);
  try {
    return address.group ? std::make_unique<MulticastSocket>(address) : nullptr;
  } catch (const std::system_error& problem) {
    throw BusError(url + ": no route for multicast (" + problem.code().message() +
                   "); bring the interface up, or on one host: ip link set lo multicast on; "
                   "ip route add 224.0.0.0/4 dev lo");
  }
}

}  // namespace

// As multicast does, it gives a sender its own messages too.
class LcmBus::InProcess {
 public:
  // Null if the name is empty.
  static std::shared_ptr<InProcess> of(const std::string& name) {
    static std::mutex mutex;
    static std::map<std::string, std::weak_ptr<InProcess>> all;
    if (name.empty()) return nullptr;
    const std::lock_guard lock(mutex);
    auto found = all[name].lock();
    if (!found) all[name] = found = std::make_shared<InProcess>();
    return found;
  }
  void join(BusInbox& inbox) {
    const std::lock_guard lock(mutex_);
    inboxes_.push_back(&inbox);
  }
  void leave(BusInbox& inbox) {
    const std::lock_guard lock(mutex_);
    std::erase(inboxes_, &inbox);
  }
  void put(std::span<const std::uint8_t> datagram) {
    const std::lock_guard lock(mutex_);
    for (BusInbox* inbox : inboxes_) inbox->put(datagram, clock_utime_us());
  }

 private:
  std::mutex mutex_;
  std::vector<BusInbox*> inboxes_;
};

LcmBus::LcmBus(const std::string& url, std::shared_ptr<trust::BusTrust> trust)
    : url_(url),
      trust_(std::move(trust)),
      socket_(open_socket(url)),
      inbox_(trust_),
      others_(InProcess::of(address_of(url).name)) {
  if (others_) others_->join(inbox_);
}

LcmBus::~LcmBus() {
  stop_listening();
  if (others_) others_->leave(inbox_);
}

void LcmBus::stop_listening() {
  end_.set();
  if (receiver_.joinable()) receiver_.join();
  end_.clear();
}

void LcmBus::listen() {
  if (!socket_ || receiver_.joinable()) return;
  try {
    socket_->listen();
  } catch (const std::system_error& problem) {
    throw BusError(url_ + ": " + problem.what());
  }
  receiver_ = std::thread([this] { receive_until_ended(); });
  try {
    hear_oneself();
  } catch (...) {
    stop_listening();
    throw;
  }
}

// A firewall or a service's address filter may pass outgoing traffic only.
void LcmBus::hear_oneself() {
  constexpr int kAgain_ms = 20;
  const double end_s = clock_monotonic_s() + kSelfTest_s;
  while (inbox_.traffic().received == 0) {
    if (clock_monotonic_s() > end_s) {
      throw BusError(
          "own messages do not come back; check firewall and the service's address filter");
    }
    send_self_test();
    if (inbox_.traffic().received == 0) ::poll(nullptr, 0, kAgain_ms);
  }
}

void LcmBus::receive_until_ended() {
  std::vector<std::uint8_t> buffer(kLargestDatagram);
  std::array<pollfd, 2> ready{{{socket_->descriptor(), POLLIN, 0}, {end_.descriptor(), POLLIN, 0}}};
  while (::poll(ready.data(), ready.size(), -1) >= 0 || errno == EINTR) {
    if (ready[1].revents != 0) return;
    if (ready[0].revents == 0) continue;
    if (const auto datagram = socket_->receive(buffer)) inbox_.put(*datagram, clock_utime_us());
  }
}

void LcmBus::subscribe(const std::string& channel_regex, Handler handler, QueueLimits limits,
                       Express express) {
  listen();
  try {
    inbox_.subscribe(channel_regex, std::move(handler), limits, std::move(express));
  } catch (const std::invalid_argument& problem) {
    throw BusError(problem.what());
  }
}

bool LcmBus::send(const std::string& channel, std::span<const std::uint8_t> payload) {
  std::vector<std::uint8_t> with_signature;
  if (trust_ != nullptr && channel != kSelfTestChannel) {
    with_signature = trust_->sign(channel, payload);
    payload = with_signature;
  }
  const auto datagram = make_datagram(sequence_++, channel, payload);
  if (datagram.empty()) {
    ++unsendable_;
    return true;
  }
  if (!socket_) {
    others_ ? others_->put(datagram) : inbox_.put(datagram, clock_utime_us());
    return true;
  }
  const std::error_code failure = socket_->send(datagram);
  if (failure == std::errc::message_size) ++unsendable_;
  // The error for an undeliverable datagram is reported by the next send.
  return !failure || failure == std::errc::message_size || failure == std::errc::connection_refused;
}

void LcmBus::send_self_test() { send(kSelfTestChannel, {}); }

void LcmBus::check_hearing() {
  const double now_s = clock_monotonic_s();
  if (!receiver_.joinable() || now_s < checked_s_ + kCheck_s) return;
  const std::uint64_t received = inbox_.traffic().received;
  const bool heard = received != received_;
  unanswered_ = heard ? 0 : unanswered_ + (tested_ ? 1 : 0);
  received_ = received;
  checked_s_ = now_s;
  tested_ = !heard;
  if (tested_) send_self_test();
}

int LcmBus::handle(int timeout_ms) {
  constexpr int kMost = 256;
  check_hearing();
  tell_what_is_signed();
  int handled = 0;
  while (handled < kMost && inbox_.handle_one(handled == 0 ? timeout_ms : 0)) ++handled;
  return handled;
}

// The time is the sequence, which must grow within a boot, also over a new connection.
void LcmBus::tell_what_is_signed() {
  if (trust_ == nullptr) return;
  const std::int64_t utime_us = clock_utime_us();
  if (const auto list = trust_->list_to_tell(clock_monotonic_s())) {
    publish(std::string(trust::kTrustChannel),
            trust::to_message(*list, trust_->boot_id(), utime_us, utime_us));
  }
  if (const auto settings = trust_->settings_to_tell(clock_monotonic_s())) {
    publish(std::string(trust::kSiteChannel),
            trust::to_settings_message(*settings, trust_->boot_id(), utime_us, utime_us));
  }
}

BusTraffic LcmBus::traffic() const {
  BusTraffic traffic = inbox_.traffic();
  traffic.unsendable = unsendable_;
  if (socket_) traffic.dropped = socket_->dropped();
  if (trust_ != nullptr) traffic.trust_trouble = trust_->trouble();
  return traffic;
}

}  // namespace ols
