// Asks kernel and chrony about the clock, in a thread of its own, because chronyd may be slow to
// answer or gone.
#pragma once

#include <memory>
#include <optional>

#include "edge/clock/clock_watch.h"

namespace ols {

class ClockSource {
 public:
  explicit ClockSource(double interval_s = 5.0);
  ~ClockSource();
  ClockSource(const ClockSource&) = delete;
  ClockSource& operator=(const ClockSource&) = delete;

  std::optional<ClockReading> take();  // since the last call

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols
