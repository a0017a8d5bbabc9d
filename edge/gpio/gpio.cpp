#include "edge/gpio/gpio.h"

#include <poll.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "base/process/clocks.h"
#include "base/process/wakeup.h"
#include "edge/gpio/gpio_lines.h"
#include "edge/gpio/gpio_report.h"
#include "edge/gpio/line_use.h"
#include "edge/gpio/rearm_input.h"
#include "edge/gpio/stop_input.h"

namespace ols::gpio {
namespace {

constexpr double kRefresh_s = 0.1;  // maximum interval between readings of the stop level
constexpr double kReopen_s = 0.5;
constexpr double kNever_s = std::numeric_limits<double>::infinity();

}  // namespace

struct Gpio::Impl {
  Impl(const GpioConfig& gpio_config, std::function<void(bool)> stop_callback,
       std::function<void()> rearm_callback)
      : config(gpio_config),
        on_stop(std::move(stop_callback)),
        on_rearm(std::move(rearm_callback)),
        stop(gpio_config.stop_release_s),
        rearm(gpio_config.rearm_hold_s) {}

  void run(const std::stop_token& ended) {
    const std::stop_callback wake(ended, [this] { wakeup.set(); });
    while (!ended.stop_requested()) {
      try {
        const auto lines = open_gpio_lines(config.chip, line_use(config));
        opened();
        serve(*lines, ended);
        if (config.led_line >= 0) lines->write(config.led_line, false);
      } catch (const std::exception& failure) {
        note_failure(failure.what());
      }
      sleep_until(clock_monotonic_s() + kReopen_s, ended);
    }
  }

  void serve(GpioLines& lines, const std::stop_token& ended) {
    double refresh_s = 0.0;
    std::optional<bool> lit;          // as written to the line
    double trigger_end_s = kNever_s;  // a pulse is on the line until then
    while (!ended.stop_requested()) {
      // First: after a suspension an answer may be waiting, however old its request.
      take_levels(lines);
      tell_stop();
      tell_rearm();
      double now_s = clock_monotonic_s();
      if (now_s >= refresh_s) {
        lines.refresh();
        refresh_s = now_s + kRefresh_s;
      }
      drive_led(lines, lit);
      drive_trigger(lines, trigger_end_s);
      now_s = clock_monotonic_s();
      double until_s = std::min({refresh_s, next_led_slot_s(now_s), trigger_end_s});
      // (Only this thread writes `facts.pressed`.)
      if (const auto due_s = stop.due_s(); due_s && facts.pressed != false) {
        until_s = std::min(until_s, *due_s);
      }
      if (const auto due_s = rearm.due_s()) until_s = std::min(until_s, *due_s);
      wait(lines.fds(), until_s - now_s);
    }
  }

  void take_levels(GpioLines& lines) {
    std::vector<LineLevel> levels = lines.receive();
    std::ranges::stable_sort(levels, {}, &LineLevel::time_s);
    for (const LineLevel& level : levels) {
      if (level.line == config.rearm_line) {
        rearm.level(level.high != config.rearm_active_low, level.time_s);
        continue;
      }
      if (level.line != config.stop_line) continue;
      const bool pressed = level.high != config.stop_active_low;
      stop.level(pressed, level.time_s);
      // At each edge: a press that ended before this thread woke still counts.
      if (pressed) tell_stop();
    }
    const std::lock_guard lock(mutex);
    if (!levels.empty() || (!config.has_stop() && config.rearm_line < 0)) {
      facts.last_good_s = clock_monotonic_s();
      facts.readable = true;
    }
  }

  // Calls back when the answer has changed.
  void tell_stop() {
    if (!config.has_stop()) return;
    if (const auto pressed = stop.pressed(clock_monotonic_s())) tell(*pressed);
  }

  void tell(bool pressed) {
    {
      const std::lock_guard lock(mutex);
      if (facts.pressed == pressed) return;
      facts.pressed = pressed;
      if (pressed) ++facts.presses;
    }
    rearm.interrupted();
    if (on_stop) on_stop(pressed);
  }

  // Has no effect while the stop is pressed.
  void tell_rearm() {
    if (config.rearm_line < 0 || !rearm.take(clock_monotonic_s())) return;
    {
      const std::lock_guard lock(mutex);
      if (config.has_stop() && facts.pressed != false) return;
      ++facts.rearms;
    }
    if (on_rearm) on_rearm();
  }

  double next_led_slot_s(double now_s) {
    const std::lock_guard lock(mutex);
    const double slots = std::floor((now_s - pattern_began_s) / kLedSlot_s + 1e-6) + 1.0;
    return pattern_began_s + slots * kLedSlot_s;
  }

  void drive_led(GpioLines& lines, std::optional<bool>& lit) {
    if (config.led_line < 0) return;
    bool wanted = false;
    {
      const std::lock_guard lock(mutex);
      wanted = led_lit(pattern, clock_monotonic_s() - pattern_began_s);
    }
    if (lit == wanted) return;
    lines.write(config.led_line, wanted);
    lit = wanted;
  }

  void drive_trigger(GpioLines& lines, double& end_s) {
    const double now_s = clock_monotonic_s();
    if (now_s >= end_s) {
      lines.write(config.trigger_line, false);
      end_s = kNever_s;
    }
    {
      const std::lock_guard lock(mutex);
      if (end_s != kNever_s || !std::exchange(trigger_wanted, false)) return;
      ++facts.triggers;
    }
    lines.write(config.trigger_line, true);
    end_s = clock_monotonic_s() + config.trigger_pulse_s;
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

  void opened() {
    const std::lock_guard lock(mutex);
    facts.open = true;
    facts.readable = false;
    trigger_wanted = false;  // an old request, for past frames
  }

  void note_failure(const std::string& what) {
    stop.lost();
    rearm.interrupted();
    {
      const std::lock_guard lock(mutex);
      facts.open = facts.readable = false;
      ++facts.failures;
      facts.error = what;
    }
    if (config.has_stop()) tell(true);
  }

  const GpioConfig config;
  const std::function<void(bool)> on_stop;
  const std::function<void()> on_rearm;
  StopInput stop;  // this and the next: used by the thread only
  RearmInput rearm;
  Wakeup wakeup;

  mutable std::mutex mutex;  // guards all members below
  GpioFacts facts;
  LedPattern pattern = LedPattern::kOff;
  double pattern_began_s = 0.0;
  bool trigger_wanted = false;
  std::jthread thread;  // last: it uses the rest
};

Gpio::Gpio(const GpioConfig& config, std::function<void(bool pressed)> on_stop,
           std::function<void()> on_rearm)
    : impl_(std::make_unique<Impl>(config, std::move(on_stop), std::move(on_rearm))) {
  if (config.chip.empty()) return;
  impl_->thread = std::jthread([impl = impl_.get()](const std::stop_token& t) { impl->run(t); });
}

Gpio::~Gpio() = default;  // the jthread asks to stop and joins

void Gpio::show(LedPattern pattern) {
  {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->pattern == pattern) return;
    impl_->pattern = pattern;
    impl_->pattern_began_s = clock_monotonic_s();
  }
  impl_->wakeup.set();
}

void Gpio::trigger() {
  if (impl_->config.trigger_line < 0) return;
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->trigger_wanted = impl_->facts.open;
  }
  impl_->wakeup.set();
}

bool Gpio::stop_pressed() const {
  const std::lock_guard lock(impl_->mutex);
  return ols::gpio::stop_pressed(impl_->config, impl_->facts);
}

device::DeviceReport Gpio::report() const {
  const std::lock_guard lock(impl_->mutex);
  return make_gpio_report(impl_->config, impl_->facts);
}

}  // namespace ols::gpio
