// The simulated lens on a pseudo terminal in real time; ols-station opens it as its serial device.
#pragma once

#include <memory>
#include <string>

#include "sim/lens/lens_unit.h"

namespace ols::sim {

class LensLine {
 public:
  // `link`: as for Pty. Throws std::system_error.
  explicit LensLine(const LensUnitConfig& config, const std::string& link = "");
  ~LensLine();
  LensLine(const LensLine&) = delete;
  LensLine& operator=(const LensLine&) = delete;

  const std::string& device() const;  // the pty's slave

  // The true zoom position at an instant of CLOCK_MONOTONIC, now or a little earlier.
  double zoom_at(double monotonic_s) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
