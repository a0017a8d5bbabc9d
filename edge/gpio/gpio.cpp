#include "edge/gpio/gpio.h"

#include <poll.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "base/process/clocks.h"
#include "base/process/wakeup.h"
#include "edge/gpio/line_use.h"

namespace ols::gpio {
namespace {

constexpr double kReopen_s = 0.5;

}  // namespace

struct Gpio::Impl {
  Impl(GpioHandover& shared, const GpioConfig& gpio_config) : gpio(shared), config(gpio_config) {}

  void run(const std::stop_token& ended) {
    const std::stop_callback wake(ended, [this] { wakeup.set(); });
    while (!ended.stop_requested()) {
      try {
        const auto lines = open_gpio_lines(config.chip, line_use(config));
        gpio.opened();
        while (!ended.stop_requested()) {
          const double until_s = gpio.turn(*lines);
          wait(lines->fds(), until_s - clock_monotonic_s());
        }
        gpio.leave(*lines);
      } catch (const std::exception& failure) {
        gpio.failed(failure.what());
      }
      sleep_until(clock_monotonic_s() + kReopen_s, ended);
    }
  }

  // Until an edge, a wakeup or the time.
  void wait(const std::vector<int>& fds, double timeout_s) {
    std::vector<pollfd> entries{{wakeup.descriptor(), POLLIN, 0}};
    for (const int fd : fds) entries.push_back({fd, POLLIN, 0});
    const double bounded_s = std::clamp(timeout_s, 0.0, 1.0);
    const timespec timeout{static_cast<time_t>(bounded_s),
                           static_cast<long>(std::fmod(bounded_s, 1.0) * 1e9)};
    ::ppoll(entries.data(), entries.size(), &timeout, nullptr);
    wakeup.clear();
  }

  void sleep_until(double end_s, const std::stop_token& ended) {
    while (!ended.stop_requested() && clock_monotonic_s() < end_s) {
      wait({}, end_s - clock_monotonic_s());
    }
  }

  GpioHandover& gpio;
  const GpioConfig config;
  Wakeup wakeup;
  std::jthread thread;  // last: it uses the rest
};

Gpio::Gpio(const GpioConfig& config, OnStop on_stop, OnRearm on_rearm)
    : GpioHandover(config, std::move(on_stop), std::move(on_rearm)),
      impl_(std::make_unique<Impl>(*this, config)) {
  if (config.chip.empty()) return;
  impl_->thread = std::jthread([impl = impl_.get()](const std::stop_token& t) { impl->run(t); });
}

Gpio::~Gpio() = default;  // the jthread asks to stop and joins

void Gpio::wake() { impl_->wakeup.set(); }

}  // namespace ols::gpio
