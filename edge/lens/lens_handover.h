// The motorised lens, between the control loop and the owner of its line (LensMotor, on a serial
// line). Holds the driver. Nothing throws.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "edge/device/device_report.h"
#include "edge/device/reading_queue.h"
#include "edge/lens/lens_config.h"
#include "edge/lens/lens_driver.h"
#include "edge/lens/lens_types.h"

namespace ols::lens {

class LensHandover {
 public:
  explicit LensHandover(const LensMotorConfig& config) : driver_(config.poll_interval_s) {}
  virtual ~LensHandover() = default;
  LensHandover(const LensHandover&) = delete;
  LensHandover& operator=(const LensHandover&) = delete;

  // From any thread; does not wait.
  void order(const LensOrder& order);
  // Samples since the last call, oldest first.
  std::vector<ZoomSample> take_samples();
  ByAxis<std::optional<double>> positions() const;
  device::DeviceReport report() const;

  // For the owner of the line. One turn takes what has arrived; it returns what to send, whether
  // the lens has reported its zoom, and whether to reopen the line.
  struct Turn {
    std::string request;
    bool works = false;
    bool link_lost = false;
  };
  Turn turn(const std::string& arrived);
  // The line was reopened: it may be another lens.
  void restart();

 private:
  // What is known of the line, without the lens.
  virtual device::DeviceReport line() const = 0;

  mutable std::mutex mutex_;  // of everything below
  LensDriver driver_;
  device::ReadingQueue<ZoomSample> samples_;
};

}  // namespace ols::lens
