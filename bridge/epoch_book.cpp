#include "bridge/epoch_book.h"

#include <algorithm>

namespace ols::bridge {
namespace {

constexpr std::size_t kMostTargets = 1000;

}  // namespace

bool EpochBook::passes(const std::string& station, const std::string& target, std::uint64_t epoch,
                       double now_s) {
  Station& one = stations_[station];
  const bool is_led = now_s - one.by.heard_s <= kSilence_s && one.by.epoch > 0;
  if (epoch < one.by.epoch && is_led) return false;
  if (epoch > 0) {
    std::uint64_t& greatest = one.targets[target];
    if (epoch < greatest) return false;
    greatest = epoch;
    forget_some(one);
  }
  one.by = {epoch, now_s};
  greatest_ = std::max(greatest_, epoch);
  return true;
}

// The lowest: those ended longest ago.
void EpochBook::forget_some(Station& station) {
  if (station.targets.size() <= kMostTargets) return;
  station.targets.erase(std::ranges::min_element(station.targets, {},
                                                 [](const auto& target) { return target.second; }));
}

}  // namespace ols::bridge
