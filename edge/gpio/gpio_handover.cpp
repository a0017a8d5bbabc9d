#include "edge/gpio/gpio_handover.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/process/clocks.h"

namespace ols::gpio {
namespace {

constexpr double kRefresh_s = 0.1;  // maximum interval between readings of the stop level

}  // namespace

GpioHandover::GpioHandover(const GpioConfig& config, OnStop on_stop, OnRearm on_rearm)
    : config_(config),
      on_stop_(std::move(on_stop)),
      on_rearm_(std::move(on_rearm)),
      stop_(config.stop_release_s),
      rearm_(config.rearm_hold_s) {}

void GpioHandover::show(LedPattern pattern) {
  {
    const std::lock_guard lock(mutex_);
    if (pattern_ == pattern) return;
    pattern_ = pattern;
    pattern_began_s_ = clock_monotonic_s();
  }
  wake();
}

void GpioHandover::trigger() {
  if (config_.trigger_line < 0) return;
  {
    const std::lock_guard lock(mutex_);
    trigger_wanted_ = facts_.open;
  }
  wake();
}

bool GpioHandover::stop_pressed() const {
  const std::lock_guard lock(mutex_);
  return ols::gpio::stop_pressed(config_, facts_);
}

device::DeviceReport GpioHandover::report() const {
  const std::lock_guard lock(mutex_);
  return make_gpio_report(config_, facts_);
}

void GpioHandover::opened() {
  refresh_s_ = 0.0;
  lit_.reset();
  trigger_end_s_ = kNever_s;
  const std::lock_guard lock(mutex_);
  facts_.open = true;
  facts_.readable = false;
  trigger_wanted_ = false;  // an old request, for past frames
}

void GpioHandover::failed(const std::string& what) {
  stop_.lost();
  rearm_.interrupted();
  {
    const std::lock_guard lock(mutex_);
    facts_.open = facts_.readable = false;
    ++facts_.failures;
    facts_.error = what;
  }
  if (config_.has_stop()) tell(true);
}

double GpioHandover::turn(GpioLines& lines) {
  // First: after a suspension an answer may be waiting, however old its request.
  take_levels(lines);
  tell_stop();
  tell_rearm();
  double now_s = clock_monotonic_s();
  if (now_s >= refresh_s_) {
    lines.refresh();
    refresh_s_ = now_s + kRefresh_s;
  }
  drive_led(lines);
  drive_trigger(lines);
  now_s = clock_monotonic_s();
  double until_s = std::min({refresh_s_, next_led_slot_s(now_s), trigger_end_s_});
  // (Only this thread writes `facts_.pressed`.)
  if (const auto due_s = stop_.due_s(); due_s && facts_.pressed != false) {
    until_s = std::min(until_s, *due_s);
  }
  if (const auto due_s = rearm_.due_s()) until_s = std::min(until_s, *due_s);
  return until_s;
}

void GpioHandover::leave(GpioLines& lines) const {
  if (config_.led_line >= 0) lines.write(config_.led_line, false);
}

void GpioHandover::take_levels(GpioLines& lines) {
  std::vector<LineLevel> levels = lines.receive();
  std::ranges::stable_sort(levels, {}, &LineLevel::time_s);
  for (const LineLevel& level : levels) {
    if (level.line == config_.rearm_line) {
      rearm_.level(level.high != config_.rearm_active_low, level.time_s);
      continue;
    }
    if (level.line != config_.stop_line) continue;
    const bool pressed = level.high != config_.stop_active_low;
    stop_.level(pressed, level.time_s);
    // At each edge: a press that ended before this thread woke still counts.
    if (pressed) tell_stop();
  }
  const std::lock_guard lock(mutex_);
  if (!levels.empty() || (!config_.has_stop() && config_.rearm_line < 0)) {
    facts_.last_good_s = clock_monotonic_s();
    facts_.readable = true;
  }
}

// Calls back when the answer has changed.
void GpioHandover::tell_stop() {
  if (!config_.has_stop()) return;
  if (const auto pressed = stop_.pressed(clock_monotonic_s())) tell(*pressed);
}

void GpioHandover::tell(bool pressed) {
  {
    const std::lock_guard lock(mutex_);
    if (facts_.pressed == pressed) return;
    facts_.pressed = pressed;
    if (pressed) ++facts_.presses;
  }
  rearm_.interrupted();
  if (on_stop_) on_stop_(pressed);
}

// Has no effect while the stop is pressed.
void GpioHandover::tell_rearm() {
  if (config_.rearm_line < 0 || !rearm_.take(clock_monotonic_s())) return;
  {
    const std::lock_guard lock(mutex_);
    if (config_.has_stop() && facts_.pressed != false) return;
    ++facts_.rearms;
  }
  if (on_rearm_) on_rearm_();
}

double GpioHandover::next_led_slot_s(double now_s) const {
  const std::lock_guard lock(mutex_);
  const double slots = std::floor((now_s - pattern_began_s_) / kLedSlot_s + 1e-6) + 1.0;
  return pattern_began_s_ + slots * kLedSlot_s;
}

void GpioHandover::drive_led(GpioLines& lines) {
  if (config_.led_line < 0) return;
  bool wanted = false;
  {
    const std::lock_guard lock(mutex_);
    wanted = led_lit(pattern_, clock_monotonic_s() - pattern_began_s_);
  }
  if (lit_ == wanted) return;
  lines.write(config_.led_line, wanted);
  lit_ = wanted;
}

void GpioHandover::drive_trigger(GpioLines& lines) {
  const double now_s = clock_monotonic_s();
  if (now_s >= trigger_end_s_) {
    lines.write(config_.trigger_line, false);
    trigger_end_s_ = kNever_s;
  }
  {
    const std::lock_guard lock(mutex_);
    if (trigger_end_s_ != kNever_s || !std::exchange(trigger_wanted_, false)) return;
    ++facts_.triggers;
  }
  lines.write(config_.trigger_line, true);
  trigger_end_s_ = clock_monotonic_s() + config_.trigger_pulse_s;
}

}  // namespace ols::gpio
