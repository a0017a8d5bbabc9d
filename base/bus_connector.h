// Makes a connection to the bus beside the loop that wants one: where multicast is blocked, its
// self test takes seconds, and a control loop must not stand still for that.
#pragma once

#include <future>
#include <memory>
#include <string>

#include "base/lcm_bus.h"

namespace ols {

class BusConnector {
 public:
  explicit BusConnector(std::string url);

  // A bus that hears itself, once there is one; until then nothing, and another attempt each
  // second. `now_s`: monotonic. Waits so long at most; an attempt ends within kLongest_s.
  std::unique_ptr<LcmBus> take(double now_s, double wait_s = 0.0);
  static constexpr double kLongest_s = 12.0;

  // Why the last attempt failed; empty when none has, or when the last one succeeded.
  const std::string& trouble() const { return trouble_; }

 private:
  void begin();

  std::string url_;
  std::future<std::unique_ptr<LcmBus>> attempt_;
  double due_s_ = 0.0;
  std::string trouble_;
};

}  // namespace ols
