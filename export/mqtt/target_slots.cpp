#include "export/mqtt/target_slots.h"

#include <algorithm>

namespace ols::exports {
namespace {

std::optional<std::size_t> find(const std::vector<std::string>& slots, const std::string& uid) {
  const auto found = std::ranges::find(slots, uid);
  if (found == slots.end()) return std::nullopt;
  return static_cast<std::size_t>(found - slots.begin());
}

}  // namespace

std::optional<std::size_t> TargetSlots::take(const std::string& uid) {
  auto slot = find(taken_, uid);
  if (!slot) slot = find(taken_, "");
  if (slot) taken_[*slot] = uid;
  return slot;
}

std::optional<std::size_t> TargetSlots::release(const std::string& uid) {
  const auto slot = find(taken_, uid);
  if (slot) taken_[*slot].clear();
  return slot;
}

}  // namespace ols::exports
