// Passes the state of the emergency stop to the control loop, from the thread that watches the
// stop's input line. Even a press that is shorter than a cycle of the loop is noticed.
#pragma once

#include <atomic>
#include <cstdint>

namespace ols::station {

class StopLatch {
 public:
  // `has_stop`: an emergency stop is configured. Its state is then unknown until the first set().
  explicit StopLatch(bool has_stop) : known_(!has_stop) {}

  // Called by the thread that watches the line, before it halts the unit.
  void set(bool pressed) {
    if (pressed) ++presses_;
    if (pressed) rearm_ = false;  // a re-arming before the press does not count
    pressed_ = pressed;
    known_ = true;
  }
  bool known() const { return known_; }
  bool pressed() const { return pressed_; }
  // True if the stop has been pressed since the last call, however briefly.
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
