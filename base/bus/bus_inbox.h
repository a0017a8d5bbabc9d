// The bounded queues of received messages. The inbox parses each datagram, and drops it if nobody
// has subscribed to its channel. One thread puts datagrams in, another takes messages out.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/bus/bus_datagram.h"
#include "base/bus/channel_pattern.h"
#include "base/trust/bus_trust.h"
#include "conditions/alarm.h"

namespace ols {

// The channel of LCM's self test; no subscription receives it.
inline constexpr const char* kSelfTestChannel = "LCM_SELF_TEST";

struct BusMessage {
  std::string channel;
  std::vector<std::uint8_t> payload;
  std::int64_t received_utime_us = 0;   // this host's clock
  std::vector<std::uint8_t> trailer{};  // the signature, as received (base/trust/trailer.h)
  // For a command: whether it names the boot id of this process. If not, only a stop may be obeyed.
  // Always true where signatures are not required.
  bool addressed = true;
  std::int64_t list_number = 0;  // number of the trust list by which the message was judged; 0:
                                 // there was no list
};

// The limit of one subscription's queue. When it is reached, the oldest messages are dropped.
struct QueueLimits {
  std::size_t messages = 1000;
  std::size_t bytes = 4'000'000;  // of names, payloads and their overhead
};

// Counters that only increase.
struct BusTraffic {
  std::uint64_t received = 0;    // whole messages, of any channel
  std::uint64_t fragments = 0;   // refused, see DatagramFault
  std::uint64_t malformed = 0;   // refused: not LCM, or with an invalid channel name
  std::uint64_t overflowed = 0;  // dropped from a full queue before they were handled
  std::uint64_t unsendable = 0;  // own messages too large for a datagram
  std::uint64_t dropped = 0;     // by the kernel, because this process did not fetch them in time
  // Messages that failed verification, by reason (trust::Distrust). They are refused where
  // signatures are required.
  std::array<std::uint64_t, static_cast<std::size_t>(trust::Distrust::kCount)> distrusted{};
  std::string distrusted_last{};  // the last such message, for a person
  Alarm trust_trouble{};          // what a person should correct in the keys or the trust list
};

class BusInbox {
 public:
  using Handler = std::function<void(const BusMessage&)>;
  // Called in the receiving thread before queueing. Returns true if the message is completely
  // handled: it is then not queued, so no flood can displace it.
  using Express = std::function<bool(const BusMessage&)>;

  // trust: null if signatures are ignored.
  explicit BusInbox(std::shared_ptr<trust::BusTrust> trust = {}) : trust_(std::move(trust)) {}

  // Throws std::invalid_argument if the channel is not a regular expression.
  void subscribe(const std::string& channel_regex, Handler handler, QueueLimits limits = {},
                 Express express = {});

  void put(std::span<const std::uint8_t> datagram, std::int64_t utime_us);

  // Passes the oldest queued message to its subscriber, in the caller's thread. Waits at most
  // timeout_ms for one. Returns whether there was one. The order of arrival counts across all
  // subscriptions.
  bool handle_one(int timeout_ms);

  BusTraffic traffic() const;

 private:
  struct Waiting {
    std::uint64_t number = 0;
    BusMessage message;
  };
  struct Subscription {
    ChannelPattern pattern;
    Handler handler;
    QueueLimits limits;
    Express express;
    std::deque<Waiting> queue;
    std::size_t bytes = 0;  // of the waiting messages
  };

  struct Admitted {
    const BusDatagram& datagram;
    trust::Judgement judgement;
    std::int64_t utime_us;
  };
  bool is_wanted(std::string_view channel);
  trust::Judgement judge(const BusDatagram& datagram, std::int64_t utime_us);
  void count(const BusDatagram& datagram, const trust::Judgement& judgement);
  void deliver(const Admitted& admitted);
  void enqueue(Subscription& subscription, BusMessage message);
  Subscription* first_waiting();
  struct Taken {
    Subscription* subscription;
    BusMessage message;
  };
  std::optional<Taken> take(int timeout_ms);

  const std::shared_ptr<trust::BusTrust> trust_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<std::unique_ptr<Subscription>> subscriptions_;  // none is ever removed
  std::uint64_t numbers_ = 0;
  BusTraffic traffic_;
};

}  // namespace ols
