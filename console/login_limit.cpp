#include "console/login_limit.h"

#include <algorithm>

namespace ols::console {

bool LoginLimit::Bucket::take(double most, double regained_s, double now_s) {
  tries = std::min(most, tries + (now_s - at_s) / regained_s);
  at_s = now_s;
  if (tries < 1.0) return false;
  tries -= 1.0;
  return true;
}

bool LoginLimit::admit(const std::string& address, double now_s) {
  // An address that has regained all its tries is like a new one, and is forgotten.
  std::erase_if(addresses_, [now_s](const auto& known) {
    return now_s - known.second.at_s > kTries * kRegained_s;
  });
  const bool is_new = !addresses_.contains(address);
  if (is_new && addresses_.size() >= kMostAddresses) return false;
  Bucket& own = addresses_.try_emplace(address, Bucket{kTries, now_s}).first->second;
  return own.take(kTries, kRegained_s, now_s) && all_.take(kAllTries, kAllRegained_s, now_s);
}

}  // namespace ols::console
