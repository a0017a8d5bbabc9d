// Operators' decisions on cues, on their way to the bus. Pure.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "console/users.h"

namespace ols::console {

struct CueOrder {
  std::string cue;
  bool allow = false;
};

class CueOrders {
 public:
  // Why the order does not go out; empty: it does.
  std::string give(const CueOrder& order, Role role, const std::string& bus_trouble);
  // The orders given since the last call.
  std::vector<CueOrder> take() { return std::exchange(given_, {}); }

 private:
  std::vector<CueOrder> given_;
};

}  // namespace ols::console
