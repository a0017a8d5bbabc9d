// The PTU driver as a pure state machine: bytes and time in, bytes and angle samples out. The
// serial port and the clock are at the edge (edge/ptu/ptu_thread.*); the lockstep simulation drives
// the same class from simulated time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edge/ptu/angle_history.h"
#include "edge/ptu/servo.h"

namespace ols {

struct PtuConfig {
  std::string device;  // serial device, for example /dev/ttyUSB0
  int baud = 9600;
  double poll_interval_s = 0.04;     // one request for both positions and the servo's commands
  double reply_timeout_s = 0.5;      // no reply for so long: the link is down, begin again
  double acceleration_rad_s2 = 1.0;  // set at start
  PtuLimits limits;                  // narrowed by what the unit reports
  AngleHistory::Config history;
  ServoConfig servo;
};

enum class PtuState { kStarting, kReady, kFault };

struct PtuCounters {  // only go up
  std::uint64_t requests = 0, replies = 0, timeouts = 0, errors = 0, garbled = 0, restarts = 0;
  std::uint64_t limit_hits = 0;
};

class PtuDriver {
 public:
  explicit PtuDriver(const PtuConfig& config);
  ~PtuDriver();
  PtuDriver(PtuDriver&&) noexcept;

  // Bytes that arrived, with an instant [s, monotonic] by which all of them were there: the moment
  // after the read.
  void receive(std::string_view bytes, double time_s);

  // Advances time: returns bytes to write now (may be empty). Call at least every few milliseconds.
  std::string step(double time_s);

  // Where the unit shall go from now on; nothing: halt. Takes effect with the next poll.
  void set_goal(const std::optional<ServoGoal>& goal);

  // Begins again from power-up, for example when the port was reopened.
  void restart(double time_s);

  // Angle samples since the last call.
  std::vector<AngleSample> take_samples();

  PtuState state() const;
  const PtuCounters& counters() const;
  const PtuLimits& limits() const;    // those in force; meaningful once ready
  double pan_resolution_rad() const;  // [rad] per count as queried
  double tilt_resolution_rad() const;
  std::string firmware() const;    // answer to V; empty until ready
  std::string last_error() const;  // empty when there was none

  // Bytes that stop the unit at once, whatever the driver was doing: for the end of the process.
  static std::string halt_request();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols
