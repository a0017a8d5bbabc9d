// Readings of a device's thread, for a caller that takes them now and then. It is bounded: if the
// caller never takes any, only the newest remain. It is not thread-safe; the owner must hold a
// lock. Pure.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace ols::device {

template <class Reading>
class ReadingQueue {
 public:
  static constexpr std::size_t kMost = 1000;

  // When the queue is full, the oldest entry is dropped.
  void add(const Reading& reading) {
    if (readings_.size() == kMost) readings_.erase(readings_.begin());
    readings_.push_back(reading);
  }

  // The readings since the last call, oldest first.
  std::vector<Reading> take() { return std::exchange(readings_, {}); }

 private:
  std::vector<Reading> readings_;
};

}  // namespace ols::device
