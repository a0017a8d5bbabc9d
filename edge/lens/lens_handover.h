// The motorised lens, between the control loop and whoever moves its bytes: LensMotor on a serial
// line. Holds the driver. Nothing throws.
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

  // For whoever moves the bytes. A turn: what has arrived; what is to be sent, whether the lens has
  // told its zoom, and whether the line is to be opened again.
  struct Turn {
    std::string request;
    bool works = false;
    bool link_lost = false;
  };
  Turn turn(const std::string& arrived);
  // The line was opened again: the lens may be another one.
  void restart();

 private:
  // What is known of the line, without the lens.
  virtual device::DeviceReport line() const = 0;

  mutable std::mutex mutex_;  // of everything below
  LensDriver driver_;
  device::ReadingQueue<ZoomSample> samples_;
};

}  // namespace ols::lens
