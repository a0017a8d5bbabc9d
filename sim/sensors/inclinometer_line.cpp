#include "sim/sensors/inclinometer_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <random>
#include <stop_token>
#include <thread>

#include "base/process/clocks.h"
#include "geometry/angles.h"
#include "sim/network/garble.h"
#include "sim/serial/pty.h"

namespace ols::sim {

namespace {

constexpr double kLongestSleep_s = 0.02;  // so that it ends promptly
constexpr const char* kVersion = "DPG2 V1.4\r\n";

}  // namespace

std::string dpg2_lines(double x_rad, double y_rad) {
  char text[64];
  std::snprintf(text, sizeof text, "X=%+07.3f\r\nY=%+07.3f\r\n", degrees(x_rad), degrees(y_rad));
  return text;
}

struct InclinometerLine::Impl {
  Impl(const InclinometerLineConfig& c, std::uint64_t seed, const std::string& link)
      : config(c), random(seed), pty(link), device(pty.device()) {
    x_zero_rad = config.zero_sd_rad * normal(random);
    y_zero_rad = config.zero_sd_rad * normal(random);
    thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  void run(const std::stop_token& stop) {
    double next_s = clock_monotonic_s();
    while (!stop.stop_requested()) {
      pty.wait(std::clamp(next_s - clock_monotonic_s(), 0.0, kLongestSleep_s));
      const InclinometerFaults now = current_faults();
      for (const char command : pty.read()) obey(command, now);
      if (clock_monotonic_s() < next_s) continue;
      next_s = std::max(next_s + 1.0 / config.rate_hz, clock_monotonic_s());
      if (streaming) send(reading(now.stuck), now);
    }
  }

  void obey(char command, const InclinometerFaults& now) {
    if (command == 's') streaming = false;
    if (command == 'S') streaming = true;
    if (command == 'R') send(reading(now.stuck), now);
    if (command == 'V') send(kVersion, now);
  }

  // Each axis of the sensor shows its own inclination to the horizontal.
  std::string reading(bool stuck) {
    const double x_rad = config.tilt_x_rad;
    const double y_rad = std::asin(std::sin(config.tilt_y_rad) * std::cos(config.tilt_x_rad));
    const double x_noise_rad = config.noise_sd_rad * normal(random);
    const double y_noise_rad = config.noise_sd_rad * normal(random);
    if (!stuck || last.empty()) {
      last = dpg2_lines(x_rad + x_zero_rad + x_noise_rad, y_rad + y_zero_rad + y_noise_rad);
    }
    return last;
  }

  void send(std::string text, const InclinometerFaults& now) {
    if (now.silent) return;
    if (std::uniform_real_distribution<double>()(random) < now.garble_share) {
      spoil_one_byte(text, random);
    }
    pty.write(text);
  }

  InclinometerFaults current_faults() {
    const std::lock_guard lock(mutex);
    return faults;
  }

  const InclinometerLineConfig config;
  std::mutex mutex;  // for faults
  InclinometerFaults faults;
  std::mt19937_64 random;
  std::normal_distribution<double> normal;
  double x_zero_rad = 0.0, y_zero_rad = 0.0;
  bool streaming = true;
  std::string last;
  Pty pty;
  std::string device;
  std::jthread thread;  // last: it uses the rest
};

InclinometerLine::InclinometerLine(const InclinometerLineConfig& config, std::uint64_t seed,
                                   const std::string& link)
    : impl_(std::make_unique<Impl>(config, seed, link)) {}

InclinometerLine::~InclinometerLine() = default;

const std::string& InclinometerLine::device() const { return impl_->device; }

void InclinometerLine::set_faults(const InclinometerFaults& faults) {
  const std::lock_guard lock(impl_->mutex);
  impl_->faults = faults;
}

}  // namespace ols::sim
