// One PTU between the control loop and whoever moves its bytes: PtuThread on a serial line. Holds
// the driver; hands out angle samples and state. All times are CLOCK_MONOTONIC in seconds.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "edge/device/device_report.h"
#include "edge/device/device_thread.h"
#include "edge/ptu/ptu_status.h"

namespace ols::ptu {

// Every method may be called from any thread; none waits for the device.
class PtuHandover {
 public:
  explicit PtuHandover(const PtuConfig& config);
  virtual ~PtuHandover() = default;
  PtuHandover(const PtuHandover&) = delete;
  PtuHandover& operator=(const PtuHandover&) = delete;

  // The goal of the unit from now on; nothing: halt.
  void set_goal(const std::optional<ServoGoal>& goal);

  // Angle samples since the last call, oldest first.
  std::vector<AngleSample> take_samples();

  // Halts the unit at once: discards the output queue and sends H first. Nothing moves until
  // clear_emergency(); halts are repeated until the unit was seen to stand. Software only assists a
  // stop in hardware.
  void emergency_halt();
  void clear_emergency();

  // As in PtuDriver.
  void home();
  void stop_homing();
  void allow_rehoming(bool allowed);  // not allowed at first
  void restore_doubt(const std::optional<PtuReferenceDoubt>& doubt);
  void reference_ok();
  PtuReference reference() const;
  std::optional<PtuReferenceDoubt> doubt_to_persist() const;

  PtuStatus status() const;
  device::DeviceReport report() const;

  // For whoever moves the bytes. A turn: what has arrived; what is to be sent, at which rate, and
  // whether the line is to be opened again.
  struct Turn {
    std::string request;
    int baud = 0;
    bool link_lost = false;
  };
  Turn turn(const std::string& arrived);
  // What goes out before everything else; nothing: no emergency has begun since the last call.
  std::optional<std::string> take_halt();
  int line_baud() const;
  // The line was gone: the unit may be another one.
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
