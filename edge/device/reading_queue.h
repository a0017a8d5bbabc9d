// A queue of a device's readings, which a caller takes from time to time. Its length is limited to
// kMost: if the caller takes none, only the newest remain. It is not thread-safe; the owner must
// hold a lock. Pure.
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

  // Takes all readings out of the queue, oldest first.
  std::vector<Reading> take() { return std::exchange(readings_, {}); }

 private:
  std::vector<Reading> readings_;
};

}  // namespace ols::device
