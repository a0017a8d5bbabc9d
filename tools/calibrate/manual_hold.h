// Whether a station that a procedure has taken into manual operation is still its: manual operation
// lasts until somebody releases it, over any restart. Pure.
#pragma once

#include <cstdint>

#include "ols_msg/station_status_t.hpp"

namespace ols::calibration {

class ManualHold {
 public:
  // The procedure has pointed the unit, which takes the station into manual operation.
  void point() { pointed_ = true; }
  // The procedure ends only the manual operation that it has begun.
  bool has_pointed() const { return pointed_; }
  // What the station says that it is doing: station_status_t's STATE_*.
  void hear(std::int8_t state) {
    const bool manual = state == ols_msg::station_status_t::STATE_MANUAL;
    lost_ = lost_ || (!manual && held_);  // for good: manual again, it is somebody else's
    held_ = held_ || (manual && pointed_);
  }
  // Somebody else has taken it back: it must not be pointed any more.
  bool is_lost() const { return lost_; }

 private:
  bool pointed_ = false, held_ = false, lost_ = false;
};

}  // namespace ols::calibration
