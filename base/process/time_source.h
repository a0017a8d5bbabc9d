// Where a process's clocks get their time: from the host, or simulated
// (sim/processes/simulated_time.h).
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <ctime>
#include <functional>
#include <mutex>

namespace ols {

class TimeSource {
 public:
  virtual std::int64_t monotonic_ns() const = 0;
  // UTC since 1970.
  virtual std::int64_t utc_ns() const = 0;
  // Waits until `over` returns true, but at most most_s. `lock` guards the data that `over` reads;
  // it is released while waiting. `news` is signalled when the data have changed.
  virtual void wait(std::unique_lock<std::mutex>& lock, std::condition_variable& news,
                    double most_s, const std::function<bool()>& over) = 0;
  // The longest time, in real seconds, that a loop waits for the result of background work. Zero on
  // a host: the loop never waits. Long if time is simulated, so that the results do not depend on
  // the speed of the computer.
  virtual std::chrono::seconds for_work() const = 0;

 protected:
  ~TimeSource() = default;  // objects are never deleted through this class
};

class HostTime final : public TimeSource {
 public:
  std::int64_t monotonic_ns() const override { return ns(CLOCK_MONOTONIC); }
  std::int64_t utc_ns() const override { return ns(CLOCK_REALTIME); }
  void wait(std::unique_lock<std::mutex>& lock, std::condition_variable& news, double most_s,
            const std::function<bool()>& over) override {
    news.wait_for(lock, std::chrono::duration<double>(most_s), over);
  }
  std::chrono::seconds for_work() const override { return std::chrono::seconds(0); }

 private:
  static std::int64_t ns(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  }
};

inline HostTime host_time;
inline std::atomic<TimeSource*> time_in_use = &host_time;

inline TimeSource& time_source() { return *time_in_use; }

}  // namespace ols
