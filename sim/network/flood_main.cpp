// ols-sim-flood: floods an LCM bus with foreign and damaged messages, with forged commands, or with
// unknown channels.

#include <algorithm>
#include <chrono>
#include <functional>
#include <iostream>
#include <limits>
#include <thread>

#include "base/bus/lcm_bus.h"
#include "base/process/clocks.h"
#include "base/process/command_line.h"
#include "base/process/shutdown.h"
#include "sim/network/command_flood.h"
#include "sim/network/flood.h"
#include "sim/network/raw_message.h"

namespace {

struct Options {
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  double rate_hz = 10000.0;
  std::vector<std::string> stations = {"alfa", "bravo", "charlie", "delta"};
  int names = 1000;
  std::string commanded;      // station of forged commands; empty: foreign messages
  std::uint64_t unknown = 0;  // number of unknown channels, then ends; 0: not this mode
  std::uint64_t seed = 1;
};

void define(CLI::App& app, Options& o) {
  app.add_option("--lcm-url", o.url, "bus")->capture_default_str();
  app.add_option("--rate", o.rate_hz, "[1/s] messages")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  app.add_option("--stations", o.stations, "ids whose channels are misused")->delimiter(',');
  app.add_option("--names", o.names, "number of different foreign channel names")
      ->check(CLI::Range(1, 1'000'000'000))
      ->capture_default_str();
  auto* commands =
      app.add_option("--commands", o.commanded,
                     "send forged commands to this station instead: most refused, some obeyed");
  app.add_option("--unknown", o.unknown,
                 "send one message each on this many unknown channels instead, and exit")
      ->check(CLI::Range(1, 1'000'000'000))
      ->excludes(commands);
  app.add_option("--seed", o.seed, "seed of all random numbers")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

// The next message to send, by its number.
std::function<ols::sim::Packet(std::uint64_t)> source(const Options& o) {
  if (o.unknown > 0) return ols::sim::unknown_channel;
  if (!o.commanded.empty()) {
    return [flood = ols::sim::CommandFlood(o.commanded, o.seed)](std::uint64_t) mutable {
      return flood.next(ols::clock_utime_us());
    };
  }
  return [flood = ols::sim::Flood(o.stations, o.names, o.seed)](std::uint64_t) mutable {
    return flood.next();
  };
}

void run(const Options& options) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kTurn = std::chrono::milliseconds(1);
  constexpr std::uint64_t kMostATurn = 10'000;  // an overloaded flood can still be ended
  constexpr auto kTell = std::chrono::seconds(1);
  ols::LcmBus bus(options.url);
  const auto next = source(options);
  const std::uint64_t most =
      options.unknown > 0 ? options.unknown : std::numeric_limits<std::uint64_t>::max();
  std::cout << "ready" << std::endl;
  const auto start = Clock::now();
  std::uint64_t sent = 0;
  auto told = start;
  while (!ols::shutdown_requested() && sent < most) {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start).count();
    const auto due = std::min(most, static_cast<std::uint64_t>(elapsed_s * options.rate_hz));
    for (const auto until = std::min(due, sent + kMostATurn); sent < until; ++sent) {
      ols::sim::Packet packet = next(sent);
      bus.publish(packet.channel, ols::sim::RawMessage{std::move(packet.data)});
    }
    if (Clock::now() - told > kTell) {
      told = Clock::now();
      std::cout << "so far " << sent << std::endl;
    }
    std::this_thread::sleep_for(kTurn);
  }
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start).count();
  std::cout << "sent " << sent << " in " << elapsed_s << " s" << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  ols::install_shutdown_handler();
  CLI::App app("Floods an LCM bus with foreign, damaged or forged messages until it is stopped.");
  Options options;
  define(app, options);
  return ols::run_command(app, argc, argv, "ols-sim-flood", [&] {
    run(options);
    return 0;
  });
}
