// Wakes the thread that makes the exposures of a simulated camera. The thread waits for an instant,
// a trigger, a client's command, or the end of the camera. All methods are thread-safe.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

#include "sim/camera/gige_device.h"

namespace ols::sim {

class ExposureCue {
 public:
  using Clock = std::chrono::steady_clock;  // CLOCK_MONOTONIC
  using Triggered = std::pair<Trigger, Clock::time_point>;

  void trigger(Trigger source);
  // A client has sent a command, which may start the stream.
  void client_spoke();
  void end();

  // wait_until() and wait_for_client() return true if end() has been called.
  bool wait_until(Clock::time_point time);
  // Waits until a client sends a command, at most `longest`. Discards earlier triggers.
  bool wait_for_client(Clock::duration longest);
  // Waits for a trigger, at most `longest`. Nullopt: there was none, or end() has been called.
  std::optional<Triggered> wait_for_trigger(Clock::duration longest);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false;
  std::optional<Triggered> triggered_;
};

}  // namespace ols::sim
