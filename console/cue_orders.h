// Holds operators' decisions on cues until they are sent to the fusion, and takes the fusion's
// answers. Pure.
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
  // Why an order cannot be given now; empty: it can.
  Outcome refusal(Role role, const Alarm& bus_trouble) const;
  // Gives an order. Call only if refusal() is empty.
  void give(wire::CueOrder order, const Ticket& ticket, double now_s);
  // The orders given since the last call, each with its own sequence number and boot id 0.
  std::vector<wire::CueOrder> take() { return std::exchange(given_, {}); }

  void receive(const wire::Reply& reply);
  // The outcomes of orders that the fusion has answered, or that have timed out.
  std::vector<Verdict> finished(double now_s);

 private:
  struct Waiting {
    wire::OrderId id;
    Ticket ticket;
    double begun_s = 0.0;
  };

  std::int64_t sequence_ = 0;  // sequence number of the last order
  std::vector<wire::CueOrder> given_;
  std::vector<Waiting> waiting_;
  std::vector<Verdict> answered_;
};

}  // namespace ols::console
