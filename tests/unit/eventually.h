// Evaluates a condition repeatedly until it is true; returns false if it is not within a generous
// time.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include "base/process/clocks.h"

namespace ols {

inline bool eventually(const std::function<bool()>& condition, double within_s = 30.0) {
  const double deadline_s = clock_monotonic_s() + within_s;
  while (!condition()) {
    if (clock_monotonic_s() > deadline_s) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

}  // namespace ols
