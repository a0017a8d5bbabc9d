#include "bridge/epoch_fence.h"

#include <algorithm>

namespace ols::bridge {
namespace {

constexpr std::size_t kMostTargets = 32, kMostStations = 2000;

}  // namespace

bool EpochFence::passes(const std::string& station, const Claim& claim, double now_s) {
  if (!is_possible(claim.epoch, now_s)) return false;
  Station* const one = station_of(station, now_s);
  if (one == nullptr) return false;
  const bool is_led = now_s - one->by.heard_s <= kSilence_s && one->by.epoch > 0;
  // An owner may lead a station from one of its targets to another.
  const bool is_its_owner = claim.epoch > 0 && !claim.owner.empty() && claim.owner == one->by.owner;
  if (claim.epoch < one->by.epoch && is_led && !is_its_owner) return false;
  if (claim.epoch > 0 && !is_greatest_of_its_target(*one, claim, now_s)) return false;
  one->by = {claim.epoch, claim.owner, now_s};
  if (claim.epoch >= greatest_) {
    greatest_ = claim.epoch;
    greatest_s_ = now_s;
  }
  return true;
}

bool EpochFence::is_possible(std::uint64_t epoch, double now_s) const {
  if (greatest_ == 0) return epoch <= kMostEver;
  const double most = static_cast<double>(greatest_) + static_cast<double>(kMostJump) +
                      kMost_Hz * std::max(0.0, now_s - greatest_s_);
  return epoch <= kMostEver && static_cast<double>(epoch) <= most;
}

// Null: there are too many.
EpochFence::Station* EpochFence::station_of(const std::string& station, double now_s) {
  if (stations_.size() >= kMostStations && !stations_.contains(station)) {
    if (now_s - swept_s_ < kSweep_s) return nullptr;
    swept_s_ = now_s;
    std::erase_if(stations_, [now_s](const auto& one) {
      return now_s - one.second.by.heard_s > kForgotten_s;
    });
    if (stations_.size() >= kMostStations) return nullptr;
  }
  return &stations_[station];
}

bool EpochFence::is_greatest_of_its_target(Station& station, const Claim& claim, double now_s) {
  auto& targets = station.targets;
  std::erase_if(targets,
                [now_s](const auto& one) { return now_s - one.second.heard_s > kForgotten_s; });
  const auto at = targets.find(claim.target);
  if (at != targets.end() && claim.epoch < at->second.epoch) return false;
  targets[claim.target] = {claim.epoch, now_s};
  if (targets.size() > kMostTargets) {
    // Forgets the lowest epoch, which began first.
    targets.erase(std::ranges::min_element(targets, {},
                                           [](const auto& target) { return target.second.epoch; }));
  }
  return true;
}

}  // namespace ols::bridge
