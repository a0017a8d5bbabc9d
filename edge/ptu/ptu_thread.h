// The thread that owns one PTU's serial port and driver, in real time. It opens the port (and opens
// it again with growing pauses when it vanishes), moves bytes, steps the driver, and hands out
// angle samples and state. All times are CLOCK_MONOTONIC in seconds.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edge/device/device_report.h"
#include "edge/ptu/driver.h"

namespace ols::ptu {

// The state of a PTU at one moment.
struct PtuStatus {
  PtuState state = PtuState::kStarting;
  struct Port {
    bool open = false;
    std::uint64_t failures = 0;  // opens that failed and ports that vanished; only goes up
    std::uint64_t reopens = 0;   // because the unit did not answer; only goes up
  } port;
  bool emergency = false;       // nothing moves until clear_emergency()
  bool standing = false;        // seen not to move
  bool not_referenced = false;  // must be homed
  bool homing = false;
  std::optional<PtuDoubtCause> doubt;
  std::optional<PtuLoweredSpeed> lowered_speed;
  int line_baud = 0;
  std::optional<double> last_good_s;  // CLOCK_MONOTONIC of the last angle
  std::optional<PtuEnvironment> environment;
  PtuCounters counters;
  PtuLimits limits;        // meaningful once ready
  std::string firmware;    // the unit's answer to V; empty until ready
  std::string last_error;  // of the port or of the unit; empty: no error so far
};

// Every method may be called from any thread; none waits for the device.
class PtuThread {
 public:
  explicit PtuThread(const PtuConfig& config);
  ~PtuThread();  // sends a halt and waits briefly until it is on the line
  PtuThread(const PtuThread&) = delete;
  PtuThread& operator=(const PtuThread&) = delete;

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

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::ptu
