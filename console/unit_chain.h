// The access units of a station's H.264 from its last key frame on. A browser is sent those that it
// has not had, in one message: it needs them all to show the newest, and their header is the newest
// one's. So one that does not keep up gets fewer and larger messages, and its picture is the newest
// all the same. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "console/heard.h"

namespace ols::console {

class UnitChain {
 public:
  // Beyond these the units wait for a key frame that never comes: all are dropped, until one does.
  static constexpr std::size_t kMostUnits = 4 * kUnitsOfKeyFrame;
  static constexpr std::size_t kMostBytes = 16U << 20U;

  // Numbers grow. What comes before the first key frame cannot be shown, and is dropped.
  void add(const Picture& unit, std::uint64_t number);
  // Of its newest unit; 0: it has none.
  std::uint64_t newest() const { return units_.empty() ? 0 : units_.back().number; }
  std::int64_t newest_utime_us() const { return units_.empty() ? 0 : units_.back().utime_us; }
  // For a browser that was sent `had` last. Call only if there is a unit.
  std::string message_after(std::uint64_t had) const;

 private:
  struct Unit {
    std::uint64_t number = 0;
    std::int64_t utime_us = 0;
    bool is_key = false;
    std::string bytes;
  };

  std::vector<Unit> units_;
  std::size_t bytes_ = 0;
  Json header_;  // of the newest
};

}  // namespace ols::console
