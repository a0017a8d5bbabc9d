// Asks kernel and chrony about the clock, in a thread of its own, because chronyd may be slow to
// answer or gone. Neither chronyc nor chronyd need be there.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edge/clock/clock_watch.h"

namespace ols {

class ClockSource {
 public:
  explicit ClockSource(double interval_s = 5.0,
                       std::vector<std::string> chronyc = {"chronyc", "-c", "tracking"});
  ~ClockSource();
  ClockSource(const ClockSource&) = delete;
  ClockSource& operator=(const ClockSource&) = delete;

  std::optional<ClockReading> take();  // since the last call

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols
