// Connects the control loop to the owner of the lens's serial line; the owner is a derived class
// such as LensMotor. Contains the driver. No function throws.
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

  // The next four functions may be called from any thread; none of them waits for the lens.
  void order(const LensOrder& order);
  // The zoom samples since the last call, oldest first.
  std::vector<ZoomSample> take_samples();
  ByAxis<std::optional<double>> positions() const;
  device::DeviceReport report() const;

  // The functions below are for the owner of the line. turn() takes the bytes that have arrived. It
  // returns the bytes to send, whether the lens has reported its zoom, and whether the line must be
  // reopened.
  struct Turn {
    std::string request;
    bool works = false;
    bool link_lost = false;
  };
  Turn turn(const std::string& arrived);
  // Notes that the line was reopened. The lens is set up again, because it may be another one.
  void restart();

 private:
  // The report about the line; report() adds the lens's data.
  virtual device::DeviceReport line() const = 0;

  mutable std::mutex mutex_;  // guards everything below
  LensDriver driver_;
  device::ReadingQueue<ZoomSample> samples_;
};

}  // namespace ols::lens
