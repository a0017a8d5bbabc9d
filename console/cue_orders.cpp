#include "console/cue_orders.h"

namespace ols::console {

std::string CueOrders::give(const wire::CueOrder& order, Role role,
                            const std::string& bus_trouble) {
  constexpr std::size_t kMost = 100;  // of a turn
  if (role == Role::kViewer) return "refused: a viewer may only look and stop";
  if (!bus_trouble.empty()) return bus_trouble;
  if (given_.size() >= kMost) return "refused: too many at once";
  given_.push_back(order);
  return {};
}

}  // namespace ols::console
