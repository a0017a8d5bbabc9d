// Operators' orders and the replies to them, as messages of the bus.
#pragma once

#include <cstdint>
#include <optional>

#include "base/bus/bus_inbox.h"
#include "base/bus/lcm_bus.h"
#include "wire/order.h"

namespace ols::wire {

// Reads an order from any sender. nullopt if the message is not an order, or does not name the
// station of its channel.
std::optional<Order> decode_order(const BusMessage& message);

// nullopt if the message is not a reply, or does not name the station of its channel. The reply's
// texts are made safe for a terminal (base/text/plain_text.h).
std::optional<Reply> decode_reply(const BusMessage& message);

// Sends orders with one boot id.
class OrderSender {
 public:
  explicit OrderSender(std::int64_t boot_id) : boot_id_(boot_id) {}

  // Returns a new id, for the next order.
  OrderId next_id() { return {boot_id_, ++sequence_}; }
  // `order.id` must be an id of this sender. `utime_us`: this host's UTC. False if the network is
  // down.
  bool send(LcmBus& bus, const Order& order, std::int64_t utime_us) const;
  bool send(LcmBus& bus, const CueOrder& order, std::int64_t utime_us) const;

 private:
  template <class Message>
  void address(Message& message, const Order& order, std::int64_t utime_us) const;

  std::int64_t boot_id_;
  std::int64_t sequence_ = 0;
};

}  // namespace ols::wire
