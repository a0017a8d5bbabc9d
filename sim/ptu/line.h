// A simulated PTU on a pseudo terminal in real time; ols-station opens it as its serial device. The
// line outlives clients: one may close the device and another open it again.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "sim/ptu/device.h"
#include "sim/ptu/unit.h"

namespace ols::sim {

class PtuLine : public PtuDevice {
 public:
  // The unit powers up now. `link`: path of a symbolic link to the device; replaces an old link,
  // and is removed at the end; empty: none. Throws std::system_error.
  PtuLine(const PtuUnitConfig& config, std::uint64_t seed, const std::string& link = "");
  ~PtuLine() override;
  PtuLine(const PtuLine&) = delete;
  PtuLine& operator=(const PtuLine&) = delete;

  // The pty's slave, for example /dev/pts/3; empty while the line is gone.
  std::string device() const;

  void set_faults(const PtuFaults& faults) override;

  // The true angles.
  PanTilt angles_at(double monotonic_s) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
