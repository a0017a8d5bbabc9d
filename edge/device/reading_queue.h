// What a device's thread has read, for a caller that takes it now and then. Bounded: one that never
// takes finds the newest. Its owner guards it. Pure.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace ols::device {

template <class Reading>
class ReadingQueue {
 public:
  static constexpr std::size_t kMost = 1000;

  // The oldest gives way when the queue is full.
  void add(const Reading& reading) {
    if (readings_.size() == kMost) readings_.erase(readings_.begin());
    readings_.push_back(reading);
  }

  // Since the last call, oldest first.
  std::vector<Reading> take() { return std::exchange(readings_, {}); }

 private:
  std::vector<Reading> readings_;
};

}  // namespace ols::device
