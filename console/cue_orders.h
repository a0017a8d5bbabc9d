// Operators' decisions on cues, on their way to the bus. Pure.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "console/users.h"
#include "wire/order.h"

namespace ols::console {

class CueOrders {
 public:
  // Why the order does not go out; empty: it does.
  std::string give(const wire::CueOrder& order, Role role, const std::string& bus_trouble);
  // The orders given since the last call.
  std::vector<wire::CueOrder> take() { return std::exchange(given_, {}); }

 private:
  std::vector<wire::CueOrder> given_;
};

}  // namespace ols::console
