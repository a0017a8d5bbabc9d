// A DPG2 inclinometer on a pseudo terminal in real time; ols-station opens it as its serial device.
// The inclinometer streams its readings from power-up on. The command 's' stops the stream, 'S'
// starts it, 'R' requests one reading, and 'V' requests the version.
#pragma once

#include <cstdint>
#include <mutex>
#include <random>
#include <stop_token>
#include <string>
#include <thread>

#include "sim/scenario/faults.h"
#include "sim/serial/pty.h"

namespace ols::sim {

struct InclinometerLineConfig {
  // The tilt of the tripod's head, as in the kinematic chain.
  double tilt_x_rad = 0.0, tilt_y_rad = 0.0;
  double zero_sd_rad = 0.0;   // of the zero error of each axis, drawn once
  double noise_sd_rad = 0.0;  // of each reading
  double rate_hz = 10.0;
};

// The text lines of one reading, in degrees with a resolution of 0.001.
std::string dpg2_lines(double x_rad, double y_rad);

class InclinometerLine {
 public:
  // `link`: as for Pty. Throws std::system_error.
  InclinometerLine(const InclinometerLineConfig& config, std::uint64_t seed,
                   const std::string& link = "");

  const std::string& device() const { return pty_.device(); }

  void set_faults(const InclinometerFaults& faults);  // from any thread

 private:
  void run(const std::stop_token& stop);
  void obey(char command, const InclinometerFaults& now);
  // One reading. Each axis of the sensor measures its own inclination to the horizontal.
  std::string reading(bool stuck);
  void send(std::string text, const InclinometerFaults& now);
  InclinometerFaults current_faults();

  const InclinometerLineConfig config_;
  std::mutex mutex_;  // for faults
  InclinometerFaults faults_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  const double x_zero_rad_, y_zero_rad_;
  bool streaming_ = true;
  std::string last_;
  Pty pty_;
  std::jthread thread_;  // last: it uses the rest
};

}  // namespace ols::sim
