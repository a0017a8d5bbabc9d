#include "edge/gpio/rearm_input.h"

namespace ols::gpio {

void RearmInput::level(bool closed, double time_s) {
  if (!closed) {
    seen_open_ = true;
    closed_s_.reset();
  } else if (seen_open_ && !closed_s_) {
    closed_s_ = time_s;
  }
}

void RearmInput::interrupted() {
  seen_open_ = false;
  closed_s_.reset();
}

bool RearmInput::take(double now_s) {
  if (!closed_s_ || now_s < *closed_s_ + hold_s_) return false;
  interrupted();
  return true;
}

std::optional<double> RearmInput::due_s() const {
  if (!closed_s_) return std::nullopt;
  return *closed_s_ + hold_s_;
}

}  // namespace ols::gpio
