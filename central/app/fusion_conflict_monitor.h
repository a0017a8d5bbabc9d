// Another fusion on the same bus: two of them slew the stations against each other. Pure.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace ols::fusion {

class FusionConflictMonitor {
 public:
  explicit FusionConflictMonitor(std::int64_t own_boot_id) : own_boot_id_(own_boot_id) {}

  // A fusion's status was heard, one's own as well; now_s: the host's monotonic clock. True for
  // another one's.
  bool hear(std::int64_t boot_id, double now_s);
  // In words, while another one was heard within the last seconds; empty otherwise.
  std::string alarm(double now_s) const;
  // Once at the beginning of such a time.
  bool take_event();

 private:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  std::int64_t own_boot_id_;
  double heard_s_ = kNever;
  bool news_ = false;
};

}  // namespace ols::fusion
