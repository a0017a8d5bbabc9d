#include "export/asterix/track_numbers.h"

namespace ols::exports {

std::uint16_t TrackNumbers::of(const std::string& uid, std::int64_t target_id) {
  if (const auto known = numbers_.find(uid); known != numbers_.end()) return known->second;
  if (numbers_.size() >= kMost) release(std::string(numbers_.begin()->first));
  auto number = static_cast<std::uint16_t>(target_id);
  while (taken_.contains(number)) ++number;
  taken_.insert(number);
  numbers_[uid] = number;
  return number;
}

void TrackNumbers::release(const std::string& uid) {
  const auto known = numbers_.find(uid);
  if (known == numbers_.end()) return;
  taken_.erase(known->second);
  numbers_.erase(known);
}

}  // namespace ols::exports
