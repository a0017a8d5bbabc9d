// Recent frame rate and losses. Pure.
#pragma once

#include <cstddef>
#include <deque>

namespace ols::camera {

class FrameStatistics {
 public:
  void add(double arrival_s, bool complete);

  double rate_hz() const;           // of complete frames; 0 before the second
  double incomplete_share() const;  // 0 without frames

 private:
  struct Mark {
    double arrival_s;
    bool complete;
  };
  std::size_t complete() const;

  std::deque<Mark> marks_;
};

}  // namespace ols::camera
