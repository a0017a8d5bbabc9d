// Passes the emergency stop from the thread that sees the line's edges to the control loop. Even a
// press shorter than a turn of the loop is caught.
#pragma once

#include <atomic>
#include <cstdint>

namespace ols::station {

class StopLatch {
 public:
  // If a stop is configured, its state is unknown until the first level arrives.
  explicit StopLatch(bool has_stop) : known_(!has_stop) {}

  // Called by the thread that sees the edges, before it halts the unit.
  void set(bool pressed) {
    if (pressed) ++presses_;
    if (pressed) rearm_ = false;  // a re-arming before the press does not count
    pressed_ = pressed;
    known_ = true;
  }
  bool known() const { return known_; }
  bool pressed() const { return pressed_; }
  // True if the stop was pressed since the last call, however briefly.
  bool take_press() {
    const std::uint64_t presses = presses_;
    const bool news = presses != seen_;
    seen_ = presses;
    return news;
  }
  // Notes that a person at the station re-arms the station. Call from the same thread as set().
  void rearm() { rearm_ = true; }
  bool take_rearm() { return rearm_.exchange(false); }

 private:
  std::atomic<bool> known_;
  std::atomic<bool> pressed_ = false;
  std::atomic<bool> rearm_ = false;
  std::atomic<std::uint64_t> presses_ = 0;
  std::uint64_t seen_ = 0;  // used by the control loop only
};

}  // namespace ols::station
