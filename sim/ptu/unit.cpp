#include "sim/ptu/unit.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/angles.h"
#include "sim/ptu/controller.h"
#include "sim/ptu/wire.h"

namespace ols::sim {

namespace {

constexpr double kHistory_s = 2.5;

// A command's delay is drawn when the command starts; the unit reads its counters within the delay.
class ReplyDelay {
 public:
  ReplyDelay(const PtuUnitConfig& config, std::uint64_t seed)
      : delay_s_(config.reply_delay_s), jitter_s_(config.reply_jitter_s), random_(seed) {}

  void forget() { drawn_.reset(); }
  double read_s() { return drawn().read_s; }                    // from the command to the counters
  double rest_s() { return drawn().whole_s - drawn().read_s; }  // from there to the answer

 private:
  struct Drawn {
    double whole_s, read_s;
  };
  const Drawn& drawn() {
    if (drawn_) return *drawn_;
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double jitter_s = jitter_s_ * (2.0 * unit(random_) - 1.0);
    const double whole_s = std::max(0.0, delay_s_ + jitter_s);
    drawn_ = {whole_s, whole_s * unit(random_)};
    return *drawn_;
  }

  double delay_s_, jitter_s_;
  std::mt19937_64 random_;
  std::optional<Drawn> drawn_;
};

}  // namespace

struct PtuUnit::Impl {
  Impl(const PtuUnitConfig& unit_config, std::uint64_t seed, double power_up_s)
      : config(unit_config),
        controller(unit_config, power_up_s),
        delay(unit_config, seed),
        wire(seed + 1),
        now_s(power_up_s) {
    begin(controller.power_up(power_up_s), power_up_s);
  }

  // Power-up.
  void begin(const PtuAnswer& ready, double time_s) {
    wire.clear(time_s);
    delay.forget();
    busy_until_s = ready.ready_s;
    pending_answer = ready;
    wire.set_baud(controller.baud());
    wire.say(controller.banner(), time_s);
  }

  // When the next internal event is due, if any.
  std::optional<double> next_event_s() {
    if (pending_answer) return pending_answer->ready_s;
    const auto command_s = wire.command_s();
    if (!command_s) return std::nullopt;
    return std::max(*command_s, busy_until_s) + delay.read_s();
  }

  void advance(double time_s) {
    now_s = std::max(now_s, time_s);
    while (true) {
      const auto event = next_event_s();
      if (!event || *event > now_s) break;
      hear(*event);
      say_tokens(*event);
      if (pending_answer) {
        answer();
      } else {
        take_command(*event);
      }
    }
    hear(now_s);
    say_tokens(now_s);
    controller.forget(now_s - kHistory_s);
  }

  // Any byte that has arrived by then, understood or not, ends a scan.
  void hear(double time_s) {
    controller.advance(time_s);
    if (!controller.scanning()) return;
    for (const PtuWire::Byte& byte : wire.input()) {
      if (byte.time_s <= time_s) controller.interrupt(byte.time_s);
    }
  }

  void say_tokens(double time_s) {
    for (const PtuToken& token : controller.take_tokens(time_s)) wire.say(token.text, token.time_s);
  }

  void answer() {
    if (!pending_answer->text.empty())
      wire.say(pending_answer->text + "\r\n", pending_answer->ready_s);
    busy_until_s = std::max(busy_until_s, pending_answer->ready_s);
    wire.set_baud(controller.baud());  // the answer to `@(` was still at the old rate
    pending_answer.reset();
  }

  void take_command(double time_s) {
    const PtuWire::Command command = wire.take_command();
    const double rest_s = delay.rest_s();
    delay.forget();
    if (command.text.empty()) return;
    if (controller.echo()) {
      wire.say(command.text + (command.delimiter == ' ' ? " " : "\r\n"), time_s);
    } else if (new_line_after(command.delimiter)) {
      wire.say("\n", time_s);
    }
    // A new rate applies from the byte after the answer on.
    pending_answer = controller.execute(command.text, time_s);
    pending_answer->ready_s = std::max(pending_answer->ready_s, time_s + rest_s);
  }

  // With its echo off an E-series unit begins a new line after a bare CR, but not after CR LF:
  // transcripts of two such units.
  bool new_line_after(char delimiter) const {
    const bool bare =
        delimiter == '\r' && (wire.input().empty() || wire.input().front().byte != '\n');
    return bare && config.model == PtuModel::kE46 && controller.talks();
  }

  PtuUnitConfig config;
  PtuController controller;
  ReplyDelay delay;
  PtuWire wire;
  double now_s;
  double busy_until_s = 0.0;  // no command is accepted before
  std::optional<PtuAnswer> pending_answer;
};

PtuUnit::PtuUnit(const PtuUnitConfig& config, std::uint64_t seed, double power_up_s)
    : impl_(std::make_unique<Impl>(config, seed, power_up_s)) {}

PtuUnit::~PtuUnit() = default;

void PtuUnit::receive(std::string_view bytes, double time_s) {
  impl_->advance(time_s);
  impl_->wire.receive(bytes, time_s);
}

std::string PtuUnit::transmit(double time_s) {
  impl_->advance(time_s);
  return impl_->wire.transmit(time_s);
}

std::optional<double> PtuUnit::next_output_s() const {
  std::optional<double> next = impl_->next_event_s();
  const auto sooner = [&next](double time_s) { next = std::min(next.value_or(time_s), time_s); };
  if (const auto output_s = impl_->wire.next_output_s()) sooner(*output_s);
  if (const auto token_s = impl_->controller.next_token_s()) sooner(*token_s);
  return next;
}

void PtuUnit::power_cycle(double time_s) {
  impl_->advance(time_s);
  impl_->begin(impl_->controller.power_cycle(time_s), time_s);
}

void PtuUnit::home_at_power_up(bool homes) { impl_->controller.home_at_power_up(homes); }

void PtuUnit::switch_echo_on(double time_s) {
  impl_->advance(time_s);
  impl_->controller.switch_echo_on();
}

void PtuUnit::slip(double pan_rad, double time_s) {
  impl_->advance(time_s);
  const double step_rad = radians(impl_->config.resolution_arcsec / 3600.0);
  impl_->controller.slip(0, static_cast<int>(std::lround(pan_rad / step_rad)), time_s);
}

void PtuUnit::set_master_baud(int baud) { impl_->wire.set_master_baud(baud); }

PanTilt PtuUnit::angles_at(double time_s) const {
  const double step_rad = radians(impl_->config.resolution_arcsec / 3600.0);
  return {impl_->controller.position_counts(0, time_s) * step_rad,
          impl_->controller.position_counts(1, time_s) * step_rad};
}

}  // namespace ols::sim
