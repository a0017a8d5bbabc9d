// The events for which the exposing thread of a simulated camera waits: an instant, a trigger, a
// client, the end. Call all methods from any thread.
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
  // The client has sent a command, perhaps to start.
  void client_spoke();
  void end();

  // Both return true when the camera is to end.
  bool wait_until(Clock::time_point time);
  // Waits while no client streams. Forgets triggers.
  bool wait_for_client(Clock::duration longest);
  // Nullopt without a trigger, or at the end.
  std::optional<Triggered> wait_for_trigger(Clock::duration longest);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false;
  std::optional<Triggered> triggered_;
};

}  // namespace ols::sim
