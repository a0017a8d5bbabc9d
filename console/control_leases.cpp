#include "console/control_leases.h"

#include <cmath>

#include "conditions/sayings.h"

namespace ols::console {

void ControlLeases::set(const std::string& station, std::uint64_t viewer, const std::string& name,
                        double now_s) {
  Holder& holder = holders_[station];
  if (holder.viewer != viewer) changed_.push_back(station);
  holder = {viewer, name, now_s + timeout_s_};
}

Outcome ControlLeases::use(const std::string& station, std::uint64_t viewer,
                           const std::string& name, double now_s) {
  const auto held = holders_.find(station);
  if (held != holders_.end() && held->second.viewer != viewer && now_s < held->second.until_s) {
    const auto left_s = static_cast<std::int64_t>(std::ceil(held->second.until_s - now_s));
    return outcome::others_control(held->second.name, left_s);
  }
  set(station, viewer, name, now_s);
  return {};
}

void ControlLeases::take(const std::string& station, std::uint64_t viewer, const std::string& name,
                         double now_s) {
  set(station, viewer, name, now_s);
}

std::uint64_t ControlLeases::holder(const std::string& station, double now_s) const {
  const auto held = holders_.find(station);
  return held == holders_.end() || now_s >= held->second.until_s ? 0 : held->second.viewer;
}

void ControlLeases::give_up(const std::string& station, std::uint64_t viewer) {
  const auto held = holders_.find(station);
  if (held == holders_.end() || held->second.viewer != viewer) return;
  holders_.erase(held);
  changed_.push_back(station);
}

void ControlLeases::leave(std::uint64_t viewer) {
  std::erase_if(holders_, [&](const auto& held) {
    if (held.second.viewer != viewer) return false;
    changed_.push_back(held.first);
    return true;
  });
}

std::vector<std::pair<std::string, std::optional<Holder>>> ControlLeases::changes(double now_s) {
  std::erase_if(holders_, [&](const auto& held) {
    if (now_s < held.second.until_s) return false;
    changed_.push_back(held.first);
    return true;
  });
  std::vector<std::pair<std::string, std::optional<Holder>>> result;
  for (const std::string& station : changed_) {
    const auto held = holders_.find(station);
    result.emplace_back(station,
                        held == holders_.end() ? std::nullopt : std::optional(held->second));
  }
  changed_.clear();
  return result;
}

}  // namespace ols::console
