// A DPG2 inclinometer on a pseudo terminal in real time; ols-station opens it as its serial device.
// It streams from power-up. 's' stops the stream, 'S' starts it, 'R' requests one reading, 'V' the
// version.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "sim/scenario/faults.h"

namespace ols::sim {

struct InclinometerLineConfig {
  // Of the tripod's head, as in the kinematic chain.
  double tilt_x_rad = 0.0, tilt_y_rad = 0.0;
  double zero_sd_rad = 0.0;   // of each axis' zero, drawn once
  double noise_sd_rad = 0.0;  // of each reading
  double rate_hz = 10.0;
};

// The lines of one reading: degrees with a resolution of 0.001.
std::string dpg2_lines(double x_rad, double y_rad);

class InclinometerLine {
 public:
  // `link`: as for Pty. Throws std::system_error.
  InclinometerLine(const InclinometerLineConfig& config, std::uint64_t seed,
                   const std::string& link = "");
  ~InclinometerLine();
  InclinometerLine(const InclinometerLine&) = delete;
  InclinometerLine& operator=(const InclinometerLine&) = delete;

  const std::string& device() const;  // the pty's slave

  void set_faults(const InclinometerFaults& faults);  // from any thread

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
