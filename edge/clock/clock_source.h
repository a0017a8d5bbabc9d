// Periodically queries kernel and chrony about the state of the clock. It has its own thread,
// because chronyd may answer slowly or not at all. It works without chronyc and chronyd, too.
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

  // The newest reading; nullopt if there is none since the last call.
  std::optional<ClockReading> take();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::clock
