// A FLIR unit as a mount. Connects the control loop to the owner of the unit's serial line; the
// owner is a derived class such as PtuThread. Contains the driver. All times are CLOCK_MONOTONIC
// [s].
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "edge/device/device_report.h"
#include "edge/device/device_thread.h"
#include "edge/mount/mount.h"
#include "edge/ptu/ptu_status.h"

namespace ols::ptu {

class PtuHandover : public mount::Mount {
 public:
  explicit PtuHandover(const PtuConfig& config);

  void set_goal(const std::optional<mount::Goal>& goal) override;
  std::vector<mount::AngleSample> take_samples() override;
  std::optional<mount::Limits> limits() const override;

  // Discards the bytes in the output queue, and sends a halt first. Halts are repeated
  // until the reported positions no longer change.
  void emergency_halt() override;
  void clear_emergency() override;

  // The functions from here to doubt_to_persist() work as those of PtuDriver.
  mount::Reference reference() const override;
  void home() override;
  void stop_homing() override;
  void allow_rehoming(bool allowed) override;
  std::uint64_t homings() const override;
  void reference_ok() override;
  void restore_doubt(const std::optional<mount::ReferenceDoubt>& doubt) override;
  std::optional<mount::ReferenceDoubt> doubt_to_persist() const override;

  PtuStatus status() const;
  device::DeviceReport report() const override;

  // The functions below are for the owner of the line. turn() takes the bytes that have arrived. It
  // returns the bytes to send, the baud rate for them, and whether the line must be reopened.
  struct Turn {
    std::string request;
    int baud = 0;
    bool link_lost = false;
  };
  Turn turn(const std::string& arrived);
  // The halt that must be sent before all other bytes; nullopt if no emergency has begun since the
  // last call.
  std::optional<std::string> take_halt();
  int line_baud() const;
  // Notes that the line was lost. The unit is started again, because it may be another one.
  void restart();

 private:
  virtual device::DeviceThread::Link link() const = 0;
  virtual void wake() {}  // called in an emergency, because a halt must be sent

  const PtuConfig config_;
  std::atomic<bool> emergency_ = false;
  std::atomic<bool> halt_wanted_ = false;  // a halt must still be sent
  mutable std::mutex mutex_;               // guards everything below
  PtuDriver driver_;
  std::uint64_t reopens_ = 0;
};

}  // namespace ols::ptu
