#include "sim/processes/simulated_time.h"

#include <cmath>

namespace ols::sim {

SimulatedTime::SimulatedTime(std::int64_t start_utime_us) : start_utc_ns_(start_utime_us * 1000) {
  time_in_use = this;
}

SimulatedTime::~SimulatedTime() { time_in_use = &host_time; }

bool SimulatedTime::pass(double most_s, const std::function<bool()>& over) {
  const std::int64_t end_ns = passed_ns_ + std::llround(most_s * 1e9);
  while (!over()) {
    if (passed_ns_ >= end_ns) return false;
    step();
  }
  return true;
}

void SimulatedTime::wait(std::unique_lock<std::mutex>& lock, std::condition_variable& /*news*/,
                         double most_s, const std::function<bool()>& over) {
  const std::int64_t end_ns = passed_ns_ + std::llround(most_s * 1e9);
  while (!steps_ && passed_ns_ < end_ns && !over()) {
    lock.unlock();
    step();
    lock.lock();
  }
}

void SimulatedTime::step() {
  passed_ns_ += kStep_ns;
  steps_ = true;
  for (const auto& act : acts_) act(now_s());
  steps_ = false;
}

}  // namespace ols::sim
