#include "edge/gpio/stop_input.h"

namespace ols::gpio {

void StopInput::level(bool pressed, double time_s) {
  if (pressed) {
    was_pressed_ = true;
    released_s_.reset();
  } else if (!released_s_) {
    released_s_ = time_s;
  }
}

void StopInput::lost() {
  was_pressed_ = true;
  released_s_.reset();
}

std::optional<bool> StopInput::pressed(double now_s) const {
  if (released_s_ && now_s >= *released_s_ + release_s_) return false;
  if (was_pressed_) return true;
  return std::nullopt;
}

std::optional<double> StopInput::due_s() const {
  if (!released_s_) return std::nullopt;
  return *released_s_ + release_s_;
}

}  // namespace ols::gpio
