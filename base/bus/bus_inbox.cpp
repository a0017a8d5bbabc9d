#include "base/bus/bus_inbox.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "base/process/clocks.h"

namespace ols {
namespace {

// Memory used by a queued message.
std::size_t cost(const BusMessage& message) {
  constexpr std::size_t kKeeping = 160;  // [byte] overhead besides names and payload
  return kKeeping + message.channel.size() + message.payload.size() + message.trailer.size();
}

}  // namespace

void BusInbox::subscribe(const std::string& channel_regex, Handler handler, QueueLimits limits,
                         Express express) {
  auto subscription = std::make_unique<Subscription>(Subscription{
      ChannelPattern(channel_regex), std::move(handler), limits, std::move(express), {}, 0});
  const std::lock_guard lock(mutex_);
  subscriptions_.push_back(std::move(subscription));
}

void BusInbox::put(std::span<const std::uint8_t> datagram, std::int64_t utime_us) {
  const auto parsed = parse_datagram(datagram);
  if (const auto* fault = std::get_if<DatagramFault>(&parsed)) {
    const std::lock_guard lock(mutex_);
    ++(*fault == DatagramFault::kFragment ? traffic_.fragments : traffic_.malformed);
    return;
  }
  const auto& whole = std::get<BusDatagram>(parsed);
  // Otherwise a station would verify the bearings of all other stations.
  if (!is_wanted(whole.channel)) return;
  // Not under the lock: to verify takes longer than to queue, and the owner must not wait for it.
  const trust::Judgement judgement = judge(whole, utime_us);
  const std::lock_guard lock(mutex_);
  count(whole, judgement);
  if (judgement.passes) deliver({whole, judgement, utime_us});
}

bool BusInbox::is_wanted(std::string_view channel) {
  const std::lock_guard lock(mutex_);
  ++traffic_.received;
  if (channel == kSelfTestChannel) return false;
  if (trust_ != nullptr && trust_->wants(channel)) return true;
  return std::ranges::any_of(subscriptions_, [channel](const auto& subscription) {
    return subscription->pattern.matches(channel);
  });
}

trust::Judgement BusInbox::judge(const BusDatagram& datagram, std::int64_t utime_us) {
  if (trust_ == nullptr) return {trust::without_trailer(datagram.payload)};
  return trust_->judge(datagram.channel, datagram.payload, utime_us, clock_monotonic_s());
}

void BusInbox::count(const BusDatagram& datagram, const trust::Judgement& judgement) {
  if (!judgement.distrust) return;
  ++traffic_.distrusted.at(static_cast<std::size_t>(*judgement.distrust));
  traffic_.distrusted_last = std::string(datagram.channel) + ": " +
                             trust::to_string(*judgement.distrust) +
                             (judgement.sender.empty() ? "" : ", by " + judgement.sender);
}

void BusInbox::deliver(const Admitted& admitted) {
  const BusDatagram& datagram = admitted.datagram;
  const auto& payload = admitted.judgement.payload;
  const auto trailer = datagram.payload.subspan(payload.size());
  for (const auto& subscription : subscriptions_) {
    if (!subscription->pattern.matches(datagram.channel)) continue;
    BusMessage message{std::string(datagram.channel),
                       {payload.begin(), payload.end()},
                       admitted.utime_us,
                       {trailer.begin(), trailer.end()},
                       admitted.judgement.addressed,
                       admitted.judgement.list_number};
    if (subscription->express && subscription->express(message)) continue;
    enqueue(*subscription, std::move(message));
  }
}

void BusInbox::enqueue(Subscription& subscription, BusMessage message) {
  subscription.bytes += cost(message);
  subscription.queue.push_back({++numbers_, std::move(message)});
  while (subscription.queue.size() > subscription.limits.messages ||
         subscription.bytes > subscription.limits.bytes) {
    subscription.bytes -= cost(subscription.queue.front().message);
    subscription.queue.pop_front();
    ++traffic_.overflowed;
  }
  arrived_.notify_one();
}

BusInbox::Subscription* BusInbox::first_waiting() {
  Subscription* first = nullptr;
  for (const auto& one : subscriptions_) {
    if (one->queue.empty()) continue;
    if (first == nullptr || one->queue.front().number < first->queue.front().number) {
      first = one.get();
    }
  }
  return first;
}

std::optional<BusInbox::Taken> BusInbox::take(int timeout_ms) {
  std::unique_lock lock(mutex_);
  if (timeout_ms > 0) {
    time_source().wait(lock, arrived_, 1e-3 * timeout_ms,
                       [this] { return first_waiting() != nullptr; });
  }
  Subscription* const first = first_waiting();
  if (first == nullptr) return std::nullopt;
  Taken taken{first, std::move(first->queue.front().message)};
  first->queue.pop_front();
  first->bytes -= cost(taken.message);
  return taken;
}

bool BusInbox::handle_one(int timeout_ms) {
  const auto taken = take(timeout_ms);
  if (taken) taken->subscription->handler(taken->message);
  return taken.has_value();
}

BusTraffic BusInbox::traffic() const {
  const std::lock_guard lock(mutex_);
  return traffic_;
}

}  // namespace ols
