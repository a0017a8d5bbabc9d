// ols-bench-bus-flood: how long a signed bearing takes from its station to the handler of a
// receiver that subscribes as the fusion does, while somebody floods the bus with unsigned ones in
// the same stations' names; for tools/bench bus-flood.
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/bus/channel_names.h"
#include "base/bus/lcm_bus.h"
#include "base/bus/message_stamp.h"
#include "base/process/clocks.h"
#include "base/trust/bus_trust.h"
#include "dev/bench/load.h"
#include "dev/bench/program.h"
#include "ols_msg/bearing_t.hpp"

namespace {

namespace trust = ols::trust;

struct Arguments {
  std::string keys;
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  double rate_hz = 33.0, flood_hz = 50'000.0, seconds = 30.0;
};

constexpr auto kSettle = std::chrono::seconds(1);  // what is still under way
constexpr const char* kFusion = "fusion";
constexpr std::size_t kStations = 4;
constexpr std::int64_t kBoot = 100;

// A member of the site whose keys are in a folder: the fusion, or a station.
std::shared_ptr<trust::BusTrust> member(const std::string& keys, const std::string& name) {
  trust::Self self;
  self.name = name;
  self.boot_id = kBoot;
  self.is_station = name != kFusion;
  return trust::BusTrust::open({}, {"require", keys, "", ""}, self);
}

std::string name_of(std::size_t station) {
  return std::string("s").append(std::to_string(station + 1));
}

bool publish_bearing(ols::LcmBus& bus, std::size_t station, std::int64_t boot_id,
                     std::size_t sequence) {
  ols_msg::bearing_t bearing{};
  ols::stamp_message(bearing, ols::clock_utime_us(), boot_id, static_cast<std::int64_t>(sequence));
  bearing.station = name_of(station);
  return bus.publish(ols::station_channel(ols::kBearingChannel, bearing.station), bearing);
}

// Their bearings one after the other; stamped right before they are signed.
class Stations {
 public:
  explicit Stations(const Arguments& arguments) {
    for (std::size_t i = 0; i < kStations; ++i) {
      buses_.push_back(
          std::make_unique<ols::LcmBus>(arguments.url, member(arguments.keys, name_of(i))));
    }
  }
  void send(std::size_t turn) {
    const std::size_t station = turn % buses_.size();
    if (publish_bearing(*buses_[station], station, kBoot, ++sequence_)) ++sent_;
  }
  std::size_t sent() const { return sent_; }

 private:
  std::vector<std::unique_ptr<ols::LcmBus>> buses_;
  std::size_t sequence_ = 0, sent_ = 0;
};

// Receives them as the fusion does; its handler only notes when.
class Fusion {
 public:
  explicit Fusion(const Arguments& arguments)
      : bus_(arguments.url, member(arguments.keys, kFusion)) {
    bus_.subscribe(
        std::string(ols::kBearingChannel) + ".*", [this](const ols::BusMessage& message) {
          ols_msg::bearing_t bearing{};
          if (!ols::decode_of_schema(message, bearing)) return;
          delays_ms_.push_back(1e-3 * static_cast<double>(ols::clock_utime_us() - bearing.utime));
        });
  }
  void handle() { bus_.handle(20); }
  std::vector<double> take_delays_ms() { return std::exchange(delays_ms_, {}); }
  ols::BusTraffic traffic() const { return bus_.traffic(); }

 private:
  ols::LcmBus bus_;
  std::vector<double> delays_ms_;
};

double resident_mb() {
  std::ifstream file("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  file >> all >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) * 1e-6;
}

struct Phase {
  double flood_hz = 0.0;  // reached
  std::size_t sent = 0;
  std::vector<double> delays_ms{};  // of those that were heard
  std::uint64_t refused = 0, dropped = 0;
};

void print(const Phase& phase) {
  const auto delay_ms = [&](double share) { return ols::bench::quantile(phase.delays_ms, share); };
  std::printf("%9.0f %9zu %9zu %9.3f %9.3f %9.3f %12llu %9llu %9.1f\n", phase.flood_hz, phase.sent,
              phase.delays_ms.size(), delay_ms(0.5), delay_ms(0.99), delay_ms(1.0),
              static_cast<unsigned long long>(phase.refused),
              static_cast<unsigned long long>(phase.dropped), resident_mb());
  std::fflush(stdout);
}

std::uint64_t unsigned_of(const ols::BusTraffic& traffic) {
  return traffic.distrusted[static_cast<std::size_t>(trust::Distrust::kUnsigned)];
}

// Unsigned bearings in the stations' names, so that each is looked at by who subscribes to them.
// Returns how many a second there were.
double flood(const Arguments& arguments, double rate_hz) {
  if (rate_hz <= 0.0) return 0.0;
  constexpr std::int64_t kNobodysBoot = 666;
  ols::LcmBus bus(arguments.url);
  std::size_t sent = 0;
  const double begin_s = ols::clock_monotonic_s();
  ols::bench::at_rate(rate_hz, arguments.seconds, [&](std::size_t turn) {
    sent += publish_bearing(bus, turn % kStations, kNobodysBoot, turn + 1);
  });
  return static_cast<double>(sent) / (ols::clock_monotonic_s() - begin_s);
}

Phase measure(const Arguments& arguments, double flood_hz, Stations& stations, Fusion& fusion) {
  Phase phase;
  const ols::BusTraffic before = fusion.traffic();
  const std::size_t sent_before = stations.sent();
  std::atomic<bool> ends = false;
  std::jthread receiver([&] {
    while (!ends) fusion.handle();
  });
  {
    std::jthread attacker([&] { phase.flood_hz = flood(arguments, flood_hz); });
    ols::bench::at_rate(arguments.rate_hz * static_cast<double>(kStations), arguments.seconds,
                        [&](std::size_t turn) { stations.send(turn); });
  }
  std::this_thread::sleep_for(kSettle);
  ends = true;
  receiver.join();
  const ols::BusTraffic after = fusion.traffic();
  phase.sent = stations.sent() - sent_before;
  phase.delays_ms = fusion.take_delays_ms();
  phase.refused = unsigned_of(after) - unsigned_of(before);
  phase.dropped = after.dropped - before.dropped;
  return phase;
}

void run(const Arguments& arguments) {
  Fusion fusion(arguments);
  Stations stations(arguments);
  std::printf("%9s %9s %9s %9s %9s %9s %12s %9s %9s\n", "flood 1/s", "bearings", "heard", "p50 ms",
              "p99 ms", "most ms", "unsigned", "dropped", "MB");
  for (const double flood_hz : {0.0, arguments.flood_hz, 0.0, arguments.flood_hz}) {
    print(measure(arguments, flood_hz, stations, fusion));
  }
}

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("--keys", arguments.keys, "folder with the keys of `fusion` and `s1` to `s4`")
      ->required();
  app.add_option("--lcm-url", arguments.url, "the bus")->capture_default_str();
  app.add_option("--rate", arguments.rate_hz, "[Hz] of each station's bearings")
      ->check(CLI::Range(0.1, 1e3))
      ->capture_default_str();
  app.add_option("--flood", arguments.flood_hz, "unsigned messages a second")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  app.add_option("--seconds", arguments.seconds, "of each of the four phases")
      ->check(CLI::Range(0.1, 86'400.0))
      ->capture_default_str();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Signed bearings in a flood of unsigned ones.", "ols-bench-bus-flood");
  Arguments arguments;
  declare(app, arguments);
  return ols::bench::run_program(app, argc, argv, [&] { run(arguments); });
}
