// ols-sim-flood: floods an LCM bus with foreign and damaged messages.

#include <chrono>
#include <iostream>
#include <thread>

#include "base/command_line.h"
#include "base/lcm_bus.h"
#include "base/shutdown.h"
#include "tools/sim/flood.h"
#include "tools/sim/raw_message.h"

namespace {

struct Options {
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  double rate_hz = 10000.0;
  std::vector<std::string> stations = {"alfa", "bravo", "charlie", "delta"};
  int names = 1000;
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
  app.add_option("--seed", o.seed, "of what is drawn")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

void run(const Options& options) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kTurn = std::chrono::milliseconds(1);
  ols::LcmBus bus(options.url);
  ols::sim::Flood flood(options.stations, options.names, options.seed);
  std::cout << "ready" << std::endl;
  const auto start = Clock::now();
  std::uint64_t sent = 0;
  while (!ols::shutdown_requested()) {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start).count();
    const auto due = static_cast<std::uint64_t>(elapsed_s * options.rate_hz);
    for (; sent < due; ++sent) {
      ols::sim::Packet packet = flood.next();
      bus.publish(packet.channel, ols::sim::RawMessage{std::move(packet.data)});
    }
    std::this_thread::sleep_for(kTurn);
  }
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start).count();
  std::cout << "sent " << sent << " in " << elapsed_s << " s" << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  ols::install_shutdown_handler();
  CLI::App app("Floods an LCM bus with foreign and damaged messages until it is ended.");
  Options options;
  define(app, options);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-sim-flood")) return *status;
  try {
    run(options);
  } catch (const std::exception& problem) {
    std::cerr << "ols-sim-flood: " << problem.what() << "\n";
    return 2;
  }
  return 0;
}
