// Whether a procedure still holds the station that it has taken into manual operation. Manual
// operation lasts until somebody releases it, over any restart. Pure.
#pragma once

#include <cstdint>

#include "ols_msg/station_status_t.hpp"

namespace ols::calibration {

class ManualHold {
 public:
  // The procedure has ordered the unit to turn. The station goes into manual operation when it
  // accepts the order.
  void point() { pointed_ = true; }
  // The station has accepted it.
  void accept() { held_ = pointed_; }
  // Whether the procedure itself has begun the manual operation. Otherwise it must not end it.
  bool has_pointed() const { return pointed_; }
  // The station's reported state: station_status_t's STATE_*.
  void hear(std::int8_t state) {
    const bool manual = state == ols_msg::station_status_t::STATE_MANUAL;
    lost_ = lost_ || (!manual && held_);  // for good: a later manual operation is somebody else's
  }
  // Somebody else has taken the station back: the procedure must not point the unit any more.
  bool is_lost() const { return lost_; }

 private:
  bool pointed_ = false, held_ = false, lost_ = false;
};

}  // namespace ols::calibration
