#include "sim/sensors/inclinometer_line.h"

#include <algorithm>
#include <cmath>

#include "base/process/clocks.h"
#include "conditions/printed.h"
#include "geometry/angles.h"
#include "sim/network/garble.h"

namespace ols::sim {

namespace {

constexpr double kLongestSleep_s = 0.02;  // so that it ends promptly
constexpr const char* kVersion = "DPG2 V1.4\r\n";

}  // namespace

std::string dpg2_lines(double x_rad, double y_rad) {
  return printed("X=%+07.3f\r\nY=%+07.3f\r\n", degrees(x_rad), degrees(y_rad));
}

InclinometerLine::InclinometerLine(const InclinometerLineConfig& config, std::uint64_t seed,
                                   const std::string& link)
    : config_(config),
      random_(seed),
      x_zero_rad_(config.zero_sd_rad * normal_(random_)),
      y_zero_rad_(config.zero_sd_rad * normal_(random_)),
      pty_(link),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void InclinometerLine::run(const std::stop_token& stop) {
  double next_s = clock_monotonic_s();
  while (!stop.stop_requested()) {
    pty_.wait(std::clamp(next_s - clock_monotonic_s(), 0.0, kLongestSleep_s));
    const InclinometerFaults now = current_faults();
    for (const char command : pty_.read()) obey(command, now);
    if (clock_monotonic_s() < next_s) continue;
    next_s = std::max(next_s + 1.0 / config_.rate_hz, clock_monotonic_s());
    if (streaming_) send(reading(now.stuck), now);
  }
}

void InclinometerLine::obey(char command, const InclinometerFaults& now) {
  if (command == 's') streaming_ = false;
  if (command == 'S') streaming_ = true;
  if (command == 'R') send(reading(now.stuck), now);
  if (command == 'V') send(kVersion, now);
}

std::string InclinometerLine::reading(bool stuck) {
  const double x_rad = config_.tilt_x_rad;
  const double y_rad = std::asin(std::sin(config_.tilt_y_rad) * std::cos(config_.tilt_x_rad));
  const double x_noise_rad = config_.noise_sd_rad * normal_(random_);
  const double y_noise_rad = config_.noise_sd_rad * normal_(random_);
  if (!stuck || last_.empty()) {
    last_ = dpg2_lines(x_rad + x_zero_rad_ + x_noise_rad, y_rad + y_zero_rad_ + y_noise_rad);
  }
  return last_;
}

void InclinometerLine::send(std::string text, const InclinometerFaults& now) {
  if (now.silent) return;
  if (std::uniform_real_distribution<double>()(random_) < now.garble_share) {
    spoil_one_byte(text, random_);
  }
  pty_.write(text);
}

InclinometerFaults InclinometerLine::current_faults() {
  const std::lock_guard lock(mutex_);
  return faults_;
}

void InclinometerLine::set_faults(const InclinometerFaults& faults) {
  const std::lock_guard lock(mutex_);
  faults_ = faults;
}

}  // namespace ols::sim
