// A FLIR unit as a mount, between the control loop and the owner of its line (PtuThread, on a
// serial line). Holds the driver. All times are CLOCK_MONOTONIC in seconds.
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

  // Discards the output queue and sends H first; halts are repeated until the unit was seen to
  // stand.
  void emergency_halt() override;
  void clear_emergency() override;

  // As in PtuDriver.
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

  // For the owner of the line. One turn takes what has arrived, and returns what to send, at which
  // rate, and whether to open the line again.
  struct Turn {
    std::string request;
    int baud = 0;
    bool link_lost = false;
  };
  Turn turn(const std::string& arrived);
  // The halt to send before anything else; nothing: no emergency has begun since the last call.
  std::optional<std::string> take_halt();
  int line_baud() const;
  // The line was lost: it may be another unit now.
  void restart();

 private:
  virtual device::DeviceThread::Link link() const = 0;
  virtual void wake() {}  // an emergency: there is something to send

  const PtuConfig config_;
  std::atomic<bool> emergency_ = false;
  std::atomic<bool> halt_wanted_ = false;  // not on the line yet
  mutable std::mutex mutex_;               // of everything below
  PtuDriver driver_;
  std::uint64_t reopens_ = 0;
};

}  // namespace ols::ptu
