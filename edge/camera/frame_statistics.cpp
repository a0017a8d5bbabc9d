#include "edge/camera/frame_statistics.h"

#include <algorithm>

namespace ols::camera {
namespace {

constexpr double kLately_s = 5.0;
constexpr std::size_t kMost = 512;

}  // namespace

void FrameStatistics::add(double arrival_s, bool complete) {
  marks_.push_back({arrival_s, complete});
  while (marks_.size() > kMost || arrival_s - marks_.front().arrival_s > kLately_s)
    marks_.pop_front();
}

std::size_t FrameStatistics::complete() const {
  return static_cast<std::size_t>(
      std::count_if(marks_.begin(), marks_.end(), [](const Mark& m) { return m.complete; }));
}

double FrameStatistics::rate_hz() const {
  if (marks_.size() < 2) return 0.0;
  const double span_s = marks_.back().arrival_s - marks_.front().arrival_s;
  if (!(span_s > 0.0)) return 0.0;
  // The share of complete frames among those that arrived between the first and the last.
  const double all = static_cast<double>(marks_.size());
  return static_cast<double>(complete()) / all * (all - 1.0) / span_s;
}

double FrameStatistics::incomplete_share() const {
  if (marks_.empty()) return 0.0;
  return 1.0 - static_cast<double>(complete()) / static_cast<double>(marks_.size());
}

}  // namespace ols::camera
