// Frame rate and share of incomplete frames over the last five seconds. Pure.
#pragma once

#include <cstddef>
#include <deque>

namespace ols::camera {

class FrameStatistics {
 public:
  void add(double arrival_s, bool complete);

  double rate_hz() const;  // rate of complete frames; 0 before the second one
  // Share of frames with missing packets; 0 if there are no frames.
  double incomplete_share() const;

 private:
  struct Mark {
    double arrival_s;
    bool complete;
  };
  std::size_t complete() const;

  std::deque<Mark> marks_;
};

}  // namespace ols::camera
