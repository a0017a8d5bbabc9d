// Detects that two fusions slew this station. Pure.
//
// After a restart, a fusion is a new sender, and the previous sender falls silent. If slews of two
// senders alternate, two fusions are running.
#pragma once

#include <cstdint>
#include <limits>

namespace ols::station {

class SlewConflictMonitor {
 public:
  // `boot_id`: identifies the fusion whose slew was accepted. `now_s`: the station's monotonic
  // clock.
  void note(std::int64_t boot_id, double now_s);
  // Whether slews of two fusions have alternated within the last five seconds.
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
