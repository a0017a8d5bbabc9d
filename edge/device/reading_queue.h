// What a device's thread has read, for a caller that takes it now and then. Bounded: if the caller
// never takes, only the newest remain. Not thread-safe; the owner holds a lock. Pure.
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

  // What has come since the last call, oldest first.
  std::vector<Reading> take() { return std::exchange(readings_, {}); }

 private:
  std::vector<Reading> readings_;
};

}  // namespace ols::device
