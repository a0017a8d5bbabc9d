#include "sim/ptu_unit.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>

#include "geometry/angles.h"
#include "sim/ptu_controller.h"

namespace ols::sim {

namespace {

constexpr double kHistory_s = 2.5;
constexpr std::size_t kInputBuffer_bytes = 512;
constexpr std::size_t kLongestCommand_bytes = 80;

double byte_time_s(int baud) { return baud > 0 ? 10.0 / baud : 0.0; }

struct TimedByte {
  char byte;
  double time_s;  // its last bit was on the line
  int baud;
};

}  // namespace

struct PtuUnit::Impl {
  Impl(const PtuUnitConfig& unit_config, std::uint64_t seed, double power_up_s)
      : config(unit_config),
        controller(unit_config, power_up_s),
        random(seed),
        now_s(power_up_s),
        noise(seed + 1) {
    begin(controller.power_up(power_up_s), power_up_s);
  }

  // The power has come.
  void begin(const PtuAnswer& ready, double time_s) {
    input.clear();
    output.clear();
    delay_drawn = false;
    line_free_s = input_free_s = time_s;
    busy_until_s = ready.ready_s;
    pending_answer = ready;
    take_rate();
    say(controller.banner(), time_s);
  }

  void take_rate() {
    baud = controller.baud();
    byte_s = byte_time_s(baud);
  }

  char on_the_line(char byte, int byte_baud) {
    const bool right = master_baud == 0 || byte_baud == 0 || master_baud == byte_baud;
    return right ? byte : static_cast<char>(noise());
  }

  // Queues text for the line, not before `time_s`, in order.
  void say(const std::string& text, double time_s) {
    for (const char byte : text) {
      line_free_s = std::max(line_free_s, time_s) + byte_s;
      output.push_back({byte, line_free_s, baud});
    }
  }

  // A command's delay is drawn when it becomes the next; within it the unit reads its counters.
  void draw_delay() {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double jitter_s = config.reply_jitter_s * (2.0 * unit(random) - 1.0);
    delay_s = std::max(0.0, config.reply_delay_s + jitter_s);
    read_s = delay_s * unit(random);
    delay_drawn = true;
  }

  // When something happens next inside the unit, or nothing.
  std::optional<double> next_event_s() {
    if (pending_answer) return pending_answer->ready_s;
    const auto delimiter = std::find_if(input.begin(), input.end(), [](const TimedByte& b) {
      return b.byte == ' ' || b.byte == '\r' || b.byte == '\n';
    });
    if (delimiter == input.end()) return std::nullopt;
    if (!delay_drawn) draw_delay();
    return std::max(delimiter->time_s, busy_until_s) + read_s;
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

  // Every byte that has come by then, understood or not, ends a scan.
  void hear(double time_s) {
    controller.advance(time_s);
    if (!controller.scanning()) return;
    for (const TimedByte& byte : input) {
      if (byte.time_s <= time_s) controller.interrupt(byte.time_s);
    }
  }

  void say_tokens(double time_s) {
    for (const PtuToken& token : controller.take_tokens(time_s)) say(token.text, token.time_s);
  }

  void answer() {
    if (!pending_answer->text.empty()) say(pending_answer->text + "\r\n", pending_answer->ready_s);
    busy_until_s = std::max(busy_until_s, pending_answer->ready_s);
    take_rate();  // the answer to `@(` was still at the old rate
    pending_answer.reset();
  }

  void take_command(double time_s) {
    std::string command;
    char delimiter = '\0';
    while (delimiter == '\0') {
      const char byte = input.front().byte;
      input.pop_front();
      if (byte == ' ' || byte == '\r' || byte == '\n') {
        delimiter = byte;
      } else if (command.size() < kLongestCommand_bytes) {
        command.push_back(byte);
      }
    }
    delay_drawn = false;
    if (command.empty()) return;
    if (controller.echo()) {
      say(command + (delimiter == ' ' ? " " : "\r\n"), time_s);
    } else if (new_line_after(delimiter)) {
      say("\n", time_s);
    }
    // A new rate holds from the byte after the answer on: the answer itself is still at the old
    // one.
    pending_answer = controller.execute(command, time_s);
    pending_answer->ready_s = std::max(pending_answer->ready_s, time_s + (delay_s - read_s));
  }

  // With its echo off an E-series unit begins a new line after a bare CR, and none after CR LF:
  // transcripts of two such units.
  bool new_line_after(char delimiter) const {
    const bool bare = delimiter == '\r' && (input.empty() || input.front().byte != '\n');
    return bare && config.model == PtuModel::kE46 && controller.talks();
  }

  PtuUnitConfig config;
  PtuController controller;
  std::mt19937_64 random;
  double now_s;
  std::mt19937_64 noise;
  int baud = 0, master_baud = 0;
  double byte_s = 0.0;
  double line_free_s = 0.0;   // our transmitter
  double input_free_s = 0.0;  // the master's
  double busy_until_s = 0.0;  // no command is taken before
  double delay_s = 0.0, read_s = 0.0;
  bool delay_drawn = false;
  std::optional<PtuAnswer> pending_answer;
  std::deque<TimedByte> input, output;
};

PtuUnit::PtuUnit(const PtuUnitConfig& config, std::uint64_t seed, double power_up_s)
    : impl_(std::make_unique<Impl>(config, seed, power_up_s)) {}

PtuUnit::~PtuUnit() = default;

void PtuUnit::receive(std::string_view bytes, double time_s) {
  impl_->advance(time_s);
  for (const char byte : bytes) {
    impl_->input_free_s = std::max(impl_->input_free_s, time_s) + impl_->byte_s;
    // A full buffer loses its last byte, so that a delimiter always gets in.
    if (impl_->input.size() == kInputBuffer_bytes) impl_->input.pop_back();
    impl_->input.push_back(
        {impl_->on_the_line(byte, impl_->baud), impl_->input_free_s, impl_->baud});
  }
}

std::string PtuUnit::transmit(double time_s) {
  impl_->advance(time_s);
  std::string bytes;
  auto& output = impl_->output;
  while (!output.empty() && output.front().time_s <= time_s) {
    bytes.push_back(impl_->on_the_line(output.front().byte, output.front().baud));
    output.pop_front();
  }
  return bytes;
}

std::optional<double> PtuUnit::next_output_s() const {
  std::optional<double> next = impl_->next_event_s();
  const auto sooner = [&next](double time_s) { next = std::min(next.value_or(time_s), time_s); };
  if (!impl_->output.empty()) sooner(impl_->output.front().time_s);
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

void PtuUnit::set_master_baud(int baud) { impl_->master_baud = baud; }

PanTilt PtuUnit::angles_at(double time_s) const {
  const double step_rad = radians(impl_->config.resolution_arcsec / 3600.0);
  return {impl_->controller.position_counts(0, time_s) * step_rad,
          impl_->controller.position_counts(1, time_s) * step_rad};
}

}  // namespace ols::sim
