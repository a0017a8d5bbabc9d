// Connects to the bus in the background. Where multicast is blocked, the self-test takes seconds,
// and no control loop may wait that long.
#pragma once

#include <future>
#include <memory>
#include <string>

#include "base/bus/lcm_bus.h"

namespace ols {

class BusConnector {
 public:
  explicit BusConnector(std::string url, std::shared_ptr<trust::BusTrust> trust = {});

  // Returns a bus that has passed its self-test, or null. Starts an attempt every second. Waits at
  // most wait_s; an attempt ends within kLongest_s. `now_s`: monotonic.
  std::unique_ptr<LcmBus> take(double now_s, double wait_s = 0.0);
  static constexpr double kLongest_s = 12.0;

  // The number of the site's settings that this process uses; 0: it has none.
  std::int64_t site_settings_number() const;

  // Why the last attempt failed; empty after a success or before the first.
  const std::string& trouble() const { return trouble_; }

 private:
  void begin();

  std::string url_;
  std::shared_ptr<trust::BusTrust> trust_;
  std::future<std::unique_ptr<LcmBus>> attempt_;
  double due_s_ = 0.0;
  std::string trouble_;
};

}  // namespace ols
