// Numbered slots, one for each present target. Home Assistant keeps an entity for every name that
// it has ever received; with a name for each target, there would be more and more entities. Pure.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ols::exports {

class TargetSlots {
 public:
  explicit TargetSlots(std::size_t count) : taken_(count) {}

  // The slot of this target: the one that it has, otherwise the first free one; nullopt: no slot is
  // free.
  std::optional<std::size_t> take(const std::string& uid);
  // Frees the target's slot and returns it.
  std::optional<std::size_t> release(const std::string& uid);
  bool is_free(std::size_t slot) const { return taken_[slot].empty(); }
  std::size_t count() const { return taken_.size(); }

 private:
  std::vector<std::string> taken_;  // uid of the target in each slot; empty: the slot is free
};

}  // namespace ols::exports
