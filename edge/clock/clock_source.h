// Queries kernel and chrony about the clock. It uses its own thread, because chronyd may answer
// slowly or not at all. Neither chronyc nor chronyd is required.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edge/clock/clock_watch.h"

namespace ols::clock {

class ClockSource {
 public:
  explicit ClockSource(double interval_s = 5.0,
                       std::vector<std::string> chronyc = {"chronyc", "-c", "tracking"});
  ~ClockSource();
  ClockSource(const ClockSource&) = delete;
  ClockSource& operator=(const ClockSource&) = delete;

  std::optional<ClockReading> take();  // the newest reading since the last call

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::clock
