// ols-sim-relay: connects two LCM buses by a bad network.

#include <iostream>
#include <regex>

#include "base/bus/lcm_bus.h"
#include "base/process/clocks.h"
#include "base/process/command_line.h"
#include "base/process/shutdown.h"
#include "sim/network/raw_message.h"
#include "sim/network/relay_queue.h"

namespace {

struct Options {
  std::string from, to;
  std::string channels = ".*";
  std::string back_channels;
  ols::sim::Impairments impairments;
  double delay_ms = 0.0, reorder_ms = 50.0;
  std::uint64_t seed = 1;
};

void define(CLI::App& app, Options& o) {
  // CLI::Range accepts NaN, because it only compares.
  const CLI::Validator number(
      [](std::string& text) { return text == "nan" ? "not a number" : std::string(); }, "");
  const auto share = [&](const char* name, double& value, const char* what) {
    app.add_option(name, value, what)->check(CLI::Range(0.0, 1.0))->check(number);
  };
  const auto milliseconds = [&](const char* name, double& value, const char* what) {
    app.add_option(name, value, what)->check(CLI::Range(0.0, 60000.0))->check(number);
  };
  app.add_option("--from", o.from, "LCM URL of one bus")->required();
  app.add_option("--to", o.to, "LCM URL of the other")->required();
  app.add_option("--channels", o.channels, "regular expression: these go from --from to --to")
      ->capture_default_str();
  app.add_option("--back-channels", o.back_channels,
                 "these go back, except those that match --channels; default: none");
  share("--loss", o.impairments.loss, "probability that a message is lost");
  share("--duplicate", o.impairments.duplicate, "probability that it is sent twice");
  share("--reorder", o.impairments.reorder, "probability that it is held back");
  milliseconds("--reorder-ms", o.reorder_ms, "[ms] how long it is held back (default 50)");
  milliseconds("--delay-ms", o.delay_ms, "[ms] delay of every message");
  app.add_option("--queue", o.impairments.capacity, "maximum messages in transit, each way")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--seed", o.seed, "seed of all random numbers")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

void receive(ols::LcmBus& bus, const std::string& channels, const std::string& but_not,
             ols::sim::RelayQueue& queue) {
  const std::regex excluded(but_not);
  bus.subscribe(channels,
                [&queue, excluded, exclude = !but_not.empty()](const ols::BusMessage& message) {
                  // The relay receives its own messages on this bus.
                  if (exclude && std::regex_match(message.channel, excluded)) return;
                  // A bridge holds no keys: signatures pass as they are.
                  auto data = message.payload;
                  data.insert(data.end(), message.trailer.begin(), message.trailer.end());
                  queue.offer({message.channel, std::move(data)}, ols::clock_monotonic_s());
                });
}

void send(ols::LcmBus& bus, ols::sim::RelayQueue& queue) {
  for (auto& packet : queue.take(ols::clock_monotonic_s())) {
    bus.publish(packet.channel, ols::sim::RawMessage{std::move(packet.data)});
  }
}

void print(const char* direction, const ols::sim::RelayQueue& queue) {
  const auto& c = queue.counts();
  std::cout << direction << ": received " << c.received << ", lost " << c.lost << ", duplicated "
            << c.duplicated << ", reordered " << c.reordered << ", overflowed " << c.overflowed
            << ", sent " << c.sent << std::endl;
}

void run(const Options& options) {
  constexpr int kTurn_ms = 1;
  ols::LcmBus from(options.from), to(options.to);
  ols::sim::RelayQueue forward(options.impairments, options.seed);
  ols::sim::RelayQueue back(options.impairments, options.seed + 1);
  receive(from, options.channels, "", forward);
  if (!options.back_channels.empty()) receive(to, options.back_channels, options.channels, back);
  std::cout << "ready" << std::endl;
  while (!ols::shutdown_requested()) {
    from.handle(kTurn_ms);
    if (!options.back_channels.empty()) to.handle(0);
    send(to, forward);
    send(from, back);
  }
  print("forward", forward);
  if (!options.back_channels.empty()) print("back", back);
}

}  // namespace

int main(int argc, char** argv) {
  ols::install_shutdown_handler();
  CLI::App app(
      "Relays messages between two LCM buses and loses, duplicates, delays and reorders them "
      "on the way. Prints its counts at the end.");
  Options options;
  define(app, options);
  return ols::run_command(app, argc, argv, "ols-sim-relay", [&] {
    options.impairments.delay_s = 1e-3 * options.delay_ms;
    options.impairments.reorder_s = 1e-3 * options.reorder_ms;
    run(options);
    return 0;
  });
}
