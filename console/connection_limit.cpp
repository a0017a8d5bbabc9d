#include "console/connection_limit.h"

namespace ols::console {

ConnectionLimit::Place ConnectionLimit::admit(const std::string& address) {
  if (taken_->all >= kMost) return nullptr;
  const auto known = taken_->of.find(address);
  if (known != taken_->of.end() && known->second >= kMostOfOne) return nullptr;
  ++taken_->all;
  ++taken_->of[address];
  return Place(taken_.get(), [taken = taken_, address](const void*) {
    --taken->all;
    if (--taken->of[address] == 0) taken->of.erase(address);
  });
}

}  // namespace ols::console
