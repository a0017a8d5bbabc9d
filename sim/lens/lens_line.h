// The simulated lens on a pseudo terminal in real time; ols-station opens it as its serial device.
#pragma once

#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "sim/lens/lens_unit.h"
#include "sim/serial/pty.h"

namespace ols::sim {

class LensLine {
 public:
  // `link`: as for Pty. Throws std::system_error.
  explicit LensLine(const LensUnitConfig& config, const std::string& link = "");

  const std::string& device() const { return pty_.device(); }

  // The true zoom position at an instant of CLOCK_MONOTONIC, from two seconds ago to now.
  double zoom_at(double monotonic_s) const;

 private:
  void run(const std::stop_token& stop);
  double sleep_s() const;

  mutable std::mutex mutex_;  // of the unit
  LensUnit unit_;
  Pty pty_;
  std::jthread thread_;  // last: it uses the rest
};

}  // namespace ols::sim
