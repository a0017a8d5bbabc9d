// The access units (pictures) of a station's H.264 video since the last key frame. To show the
// newest unit, a browser needs all units before it; therefore one message contains all units that
// the browser lacks, with the header of the newest. A slow browser gets fewer and larger messages,
// but always sees the newest picture. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "console/received.h"

namespace ols::console {

class UnitChain {
 public:
  // If this many units come without a key frame, all units are dropped until a key frame comes.
  static constexpr std::size_t kMostUnits = 4 * kUnitsOfKeyFrame;
  static constexpr std::size_t kMostBytes = 16U << 20U;

  // Adds a unit; numbers must ascend. Units before the first key frame cannot be shown and are
  // dropped.
  void add(const Picture& unit, std::uint64_t number);
  // The number of the newest unit; 0: there is none.
  std::uint64_t newest() const { return units_.empty() ? 0 : units_.back().number; }
  std::int64_t newest_utime_us() const { return units_.empty() ? 0 : units_.back().utime_us; }
  // The message for a browser that has all units up to number `had`. There must be a unit.
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
  Json header_;  // of the newest unit
};

}  // namespace ols::console
