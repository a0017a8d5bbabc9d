// A few numbered places for targets: Home Assistant keeps an entity for every name that it has ever
// heard, so that names of targets would fill it. Pure.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ols::exports {

class TargetSlots {
 public:
  explicit TargetSlots(std::size_t count) : taken_(count) {}

  // The slot of this target: its own, else the first that is free; nothing if there is none.
  std::optional<std::size_t> take(const std::string& uid);
  // The slot that it had.
  std::optional<std::size_t> release(const std::string& uid);
  bool is_free(std::size_t slot) const { return taken_[slot].empty(); }
  std::size_t count() const { return taken_.size(); }

 private:
  std::vector<std::string> taken_;  // by uid; empty: free
};

}  // namespace ols::exports
