// Whether a station is still in the manual operation that a procedure has begun. Manual operation
// lasts until somebody releases it, even over a restart of the station. Pure.
#pragma once

#include <cstdint>

#include "ols_msg/station_status_t.hpp"

namespace ols::calibration {

class ManualHold {
 public:
  // The procedure has ordered the unit to turn. The station goes into manual operation when it
  // accepts the order.
  void point() { pointed_ = true; }
  // The station has accepted the order.
  void accept() { held_ = pointed_; }
  // Whether the procedure has ordered the unit to turn. If not, somebody else has begun the manual
  // operation, and the procedure must not end it.
  bool has_pointed() const { return pointed_; }
  // Takes the station's reported state: station_status_t's STATE_*.
  void hear(std::int8_t state) {
    const bool manual = state == ols_msg::station_status_t::STATE_MANUAL;
    lost_ = lost_ || (!manual && held_);  // final: a later manual operation is somebody else's
  }
  // Whether somebody else has ended the manual operation. The procedure must not point the unit any
  // more.
  bool is_lost() const { return lost_; }

 private:
  bool pointed_ = false, held_ = false, lost_ = false;
};

}  // namespace ols::calibration
