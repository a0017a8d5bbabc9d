// ols-sim-ptu: the simulated PTU alone, as a separate process on a pseudo terminal.

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <iostream>
#include <string>

#include "base/process/clocks.h"
#include "base/process/command_line.h"
#include "base/process/shutdown.h"
#include "conditions/printed.h"
#include "geometry/angles.h"
#include "sim/ptu/console.h"
#include "sim/ptu/line.h"

namespace {

using ols::sim::PtuConsole;
using ols::sim::PtuLine;
using ols::sim::PtuModel;

constexpr int kTurn_ms = 20;  // precision of the begin and end of faults

struct Options {
  std::string link, model = "d46";
  std::uint64_t seed = 1;
  double delay_ms = 1.0, jitter_ms = 0.0;
  bool no_home = false, terse = false;
  ols::sim::PtuUnitConfig unit;
};

void define(CLI::App& app, Options& o) {
  app.add_option("--link", o.link, "symbolic link to the device, created and removed")->required();
  app.add_option("--model", o.model, "which unit it is")
      ->check(CLI::IsMember({"d46", "e46"}))
      ->capture_default_str();
  app.add_option("--firmware", o.unit.firmware, "its version, for example 2.12.1d1")
      ->default_str("the model's");
  app.add_option("--baud", o.unit.baud, "rate at power-up; 0: bytes take no time")
      ->check(CLI::IsMember({0, 600, 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200}))
      ->capture_default_str();
  app.add_option("--resolution-arcsec", o.unit.resolution_arcsec, "[arc seconds] of one count")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  app.add_option("--delay-ms", o.delay_ms, "[ms] delay of a reply")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  app.add_option("--jitter-ms", o.jitter_ms, "[ms] jitter of that, uniform +-")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  app.add_option("--parameter-set-s", o.unit.parameter_set_s, "[s] duration of setting PA PB PU PL")
      ->check(CLI::Range(0.0, 600.0))
      ->capture_default_str();
  app.add_option("--seed", o.seed, "seed of all random numbers")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag("--no-home", o.no_home, "homed before, no homing at power-up");
  app.add_flag("--terse", o.terse, "echo off and terse replies from the start");
}

ols::sim::PtuUnitConfig unit_config(const Options& o) {
  ols::sim::PtuUnitConfig config = o.unit;
  config.model = o.model == "e46" ? PtuModel::kE46 : PtuModel::kD46;
  // The default counts assume the default resolution.
  const double scale = ols::sim::PtuUnitConfig{}.resolution_arcsec / config.resolution_arcsec;
  for (int* counts : {&config.pan_min_counts, &config.pan_max_counts, &config.tilt_min_counts,
                      &config.tilt_max_counts, &config.max_speed_counts_s}) {
    *counts = static_cast<int>(*counts * scale);
  }
  config.reply_delay_s = 1e-3 * o.delay_ms;
  config.reply_jitter_s = 1e-3 * o.jitter_ms;
  config.home_at_power_up = !o.no_home;
  config.echo = config.verbose = !o.terse;
  return config;
}

void answer(PtuConsole& console, PtuLine& line, const std::string& text) {
  const double now_s = ols::clock_monotonic_s();
  const auto answer = console.take(text, now_s);
  if (const auto* words = std::get_if<std::string>(&answer)) {
    if (!words->empty()) std::cout << *words << std::endl;
    return;
  }
  const double at_s = std::get<PtuConsole::AskedAngles>(answer).at_s.value_or(now_s);
  const ols::PanTilt angles = line.angles_at(at_s);
  const std::string shown =
      ols::printed("angles %.6f s pan %.6f tilt %.6f deg", at_s, ols::degrees(angles.pan_rad),
                   ols::degrees(angles.tilt_rad));
  std::cout << shown << std::endl;
}

// Reads the available standard input; false at its end.
bool read_lines(PtuConsole& console, PtuLine& line, std::string& pending) {
  std::array<char, 512> buffer;
  const ssize_t n = ::read(STDIN_FILENO, buffer.data(), buffer.size());
  if (n <= 0) return false;
  pending.append(buffer.data(), static_cast<std::size_t>(n));
  for (std::size_t end; (end = pending.find('\n')) != std::string::npos;) {
    answer(console, line, pending.substr(0, end));
    pending.erase(0, end + 1);
  }
  return true;
}

void run(const Options& options) {
  PtuLine line(unit_config(options), options.seed, options.link);
  PtuConsole console;
  std::string pending;
  std::cout << "ready" << std::endl;
  pollfd input{STDIN_FILENO, POLLIN, 0};
  while (!ols::shutdown_requested()) {
    // Without standard input it continues.
    if (::poll(&input, 1, kTurn_ms) > 0 && !read_lines(console, line, pending)) input.fd = -1;
    line.set_faults(console.faults(ols::clock_monotonic_s()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  ols::install_shutdown_handler();
  CLI::App app(
      "A simulated PTU on a pseudo terminal, until SIGTERM or SIGINT. Standard input takes "
      "lines: fault KIND [SECONDS [VALUE]], end KIND, end all, angles [MONOTONIC_S].");
  app.set_version_flag("--version", OLS_VERSION);
  Options options;
  define(app, options);
  return ols::run_command(app, argc, argv, "ols-sim-ptu", [&] {
    run(options);
    return 0;
  });
}
