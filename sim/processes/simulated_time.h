// Time that somebody advances, for the clocks of a whole process: whoever waits lets it pass, step
// by step, and what takes part in it does its share at each step. Work in the background takes
// none.
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "base/process/time_source.h"

namespace ols::sim {

class SimulatedTime final : public TimeSource {
 public:
  // In use while it lives; there is one at a time. `start_utime_us`: UTC of the beginning.
  explicit SimulatedTime(std::int64_t start_utime_us);
  ~SimulatedTime();
  SimulatedTime(const SimulatedTime&) = delete;
  SimulatedTime& operator=(const SimulatedTime&) = delete;

  // In each step, in the order in which they were added; given the time since the beginning [s].
  // What waits in it waits in vain.
  void at_each_step(std::function<void(double)> act) { acts_.push_back(std::move(act)); }

  // Until `over`; false: it was not within this time.
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
