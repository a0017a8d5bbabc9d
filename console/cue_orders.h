// Operators' decisions on cues: on their way to the fusion, and what it answers. Pure.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "console/pending_orders.h"
#include "console/users.h"
#include "wire/order.h"

namespace ols::console {

class CueOrders {
 public:
  // Why the order does not go out; empty: it does.
  Outcome refusal(Role role, const Alarm& bus_trouble) const;
  // Of an order that is not refused.
  void give(wire::CueOrder order, const Ticket& ticket, double now_s);
  // The orders given since the last call, each under its own sequence number and the boot 0.
  std::vector<wire::CueOrder> take() { return std::exchange(given_, {}); }

  void hear(const wire::Reply& reply);
  // Orders that the fusion has answered, or whose time is over.
  std::vector<Verdict> finished(double now_s);

 private:
  struct Waiting {
    wire::OrderId id;
    Ticket ticket;
    double begun_s = 0.0;
  };

  std::int64_t sequence_ = 0;  // of the last order
  std::vector<wire::CueOrder> given_;
  std::vector<Waiting> waiting_;
  std::vector<Verdict> answered_;
};

}  // namespace ols::console
