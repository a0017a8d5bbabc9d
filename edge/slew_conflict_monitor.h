// Whether more than one fusion slews this station. Pure.
//
// A fusion that was restarted is another sender than before, but the former one is heard no more:
// two of them are at work when one that another has followed upon comes back.
#pragma once

#include <cstdint>
#include <limits>

namespace ols::station {

class SlewConflictMonitor {
 public:
  // The boot of the fusion whose slew was accepted; the station's monotonic clock.
  void note(std::int64_t boot_id, double now_s);
  // There have been two within the last seconds.
  bool are_several(double now_s) const;

 private:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  struct Sender {
    std::int64_t boot_id = 0;
    double heard_s = kNever;
  };
  Sender newest_, former_;
  double several_s_ = kNever;
};

}  // namespace ols::station
