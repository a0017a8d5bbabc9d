// Simulated time for the clocks of a whole process. A call that waits advances the time step by
// step; in each step all participants are called. Work in background threads takes no simulated
// time.
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "base/process/time_source.h"

namespace ols::sim {

class SimulatedTime final : public TimeSource {
 public:
  // While this object lives, it is the clock of the process; there may be only one such object at a
  // time. `start_utime_us`: UTC at the beginning.
  explicit SimulatedTime(std::int64_t start_utime_us);
  ~SimulatedTime();
  SimulatedTime(const SimulatedTime&) = delete;
  SimulatedTime& operator=(const SimulatedTime&) = delete;

  // Adds a participant. Participants are called in each step, in the order in which they were
  // added, with the time since the beginning [s]. A participant must not wait, because time would
  // not advance.
  void at_each_step(std::function<void(double)> act) { acts_.push_back(std::move(act)); }

  // Advances the time until `over` returns true. If `most_s` pass before that, returns false.
  bool pass(
      double most_s, const std::function<bool()>& over = [] { return false; });

  double now_s() const { return 1e-9 * static_cast<double>(passed_ns_.load()); }

  std::int64_t monotonic_ns() const override { return kBoot_ns + passed_ns_; }
  std::int64_t utc_ns() const override { return start_utc_ns_ + passed_ns_; }
  void wait(std::unique_lock<std::mutex>& lock, std::condition_variable& news, double most_s,
            const std::function<bool()>& over) override;
  std::chrono::seconds for_work() const override { return std::chrono::minutes(10); }

 private:
  static constexpr std::int64_t kStep_ns = 1'000'000, kBoot_ns = 100'000'000'000;
  void step();

  const std::int64_t start_utc_ns_;
  std::atomic<std::int64_t> passed_ns_ = 0;
  bool steps_ = false;
  std::vector<std::function<void(double)>> acts_;
};

}  // namespace ols::sim
