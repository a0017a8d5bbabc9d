// A simulated PTU on a pseudo terminal in real time; ols-station opens it as its serial device.
// When a client closes the device, the line remains, and any client may open the device again.
#pragma once

#include <cstdint>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "sim/ptu/device.h"
#include "sim/ptu/faults.h"
#include "sim/ptu/unit.h"
#include "sim/serial/pty.h"

namespace ols::sim {

class PtuLine : public PtuDevice {
 public:
  // The unit powers up now. `link`: path of a symbolic link to the device; replaces an old link,
  // and is removed at the end; empty: none. Throws std::system_error.
  PtuLine(const PtuUnitConfig& config, std::uint64_t seed, const std::string& link = "");

  // The pty's slave, for example /dev/pts/3; empty while the line is gone.
  std::string device() const;

  void set_faults(const PtuFaults& faults) override;

  // The true angles.
  PanTilt angles_at(double monotonic_s) override;

 private:
  void run(const std::stop_token& stop);
  void wait();  // until bytes arrive or the unit has bytes to send
  void replug(bool gone);
  void advance();

  mutable std::mutex mutex_;  // for everything but the pty, which only the thread uses
  FaultyPtuUnit unit_;
  std::string pending_;
  double latest_s_ = 0.0;
  Pty pty_;
  std::string device_;
  std::jthread thread_;  // last: it uses the rest
};

}  // namespace ols::sim
