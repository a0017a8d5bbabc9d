// ols-bench-bus-flood: how long a signed bearing takes from its station to the handler of a
// receiver that subscribes as the fusion does, while somebody floods the bus with unsigned ones in
// the same stations' names; for tools/bench bus-flood.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/bus/channel_names.h"
#include "base/bus/lcm_bus.h"
#include "base/bus/message_stamp.h"
#include "base/files/atomic_file.h"
#include "base/process/clocks.h"
#include "base/trust/bus_trust.h"
#include "dev/bench/program.h"
#include "ols_msg/bearing_t.hpp"

namespace {

namespace trust = ols::trust;

struct Arguments {
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  std::size_t stations = 4;
  double rate_hz = 33.0, flood_hz = 50'000.0, seconds = 30.0;
};

constexpr auto kSettle = std::chrono::seconds(1);  // what is still under way
constexpr std::size_t kFusion = 0;

// Keys of a fusion and of stations s1, s2, …, in a folder of its own as OLS_KEYS names it.
class ThrowAwaySite {
 public:
  explicit ThrowAwaySite(std::size_t stations) {
    std::string name = std::filesystem::temp_directory_path() / "ols-bench-bus-flood-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category());
    folder_ = name;
    const trust::SigningKey root(trust::draw_secret());
    trust::TrustList list;
    list.site = "bench";
    list.number = 1;
    list.root = root.public_key();
    const trust::SiteKey secret = trust::draw_secret();
    for (std::size_t i = 0; i <= stations; ++i) {
      const trust::MemberKey key{name_of(i), trust::draw_secret(), secret, root.public_key()};
      trust::write_member_key(folder_ / (key.name + ".key"), key);
      const auto role = i == kFusion ? trust::Role::kFusion : trust::Role::kStation;
      list.members.push_back({key.name, role, trust::SigningKey(key.seed).public_key()});
    }
    ols::AtomicFile file(folder_ / "trust.toml");
    file.stream() << trust::sign_list(list, root);
    file.commit();
  }
  ~ThrowAwaySite() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  ThrowAwaySite(const ThrowAwaySite&) = delete;
  ThrowAwaySite& operator=(const ThrowAwaySite&) = delete;

  static std::string name_of(std::size_t member) {
    return member == kFusion ? "fusion" : std::string("s").append(std::to_string(member));
  }
  std::shared_ptr<trust::BusTrust> open(std::size_t member) const {
    trust::Self self;
    self.name = name_of(member);
    self.boot_id = boot_of(member);
    self.is_station = member != kFusion;
    return trust::BusTrust::open({}, {"require", folder_, "", ""}, self);
  }
  static std::int64_t boot_of(std::size_t member) {
    return 100 + static_cast<std::int64_t>(member);
  }

 private:
  std::filesystem::path folder_;
};

// Calls `act` evenly in time; what fell due while this process did not run follows at once.
template <class Act>
void at_rate(double rate_hz, double seconds, Act act) {
  constexpr timespec kNap{0, 200'000};  // some messages of a flood each time
  const double begin_s = ols::clock_monotonic_s();
  const auto total = static_cast<std::size_t>(std::llround(rate_hz * seconds));
  for (std::size_t turn = 0; turn < total;) {
    const double passed_s = ols::clock_monotonic_s() - begin_s;
    const auto due = std::min(total, static_cast<std::size_t>(passed_s * rate_hz) + 1);
    while (turn < due) act(turn++);
    ::nanosleep(&kNap, nullptr);
  }
}

// Their bearings one after the other; stamped right before they are signed.
class Stations {
 public:
  Stations(const Arguments& arguments, const ThrowAwaySite& site) {
    for (std::size_t i = 1; i <= arguments.stations; ++i) {
      buses_.push_back(std::make_unique<ols::LcmBus>(arguments.url, site.open(i)));
    }
  }
  void send(std::size_t turn) {
    const std::size_t index = turn % buses_.size(), member = index + 1;
    ols_msg::bearing_t bearing{};
    ols::stamp_message(bearing, ols::clock_utime_us(), ThrowAwaySite::boot_of(member), ++sequence_);
    bearing.station = ThrowAwaySite::name_of(member);
    const std::string channel = ols::station_channel(ols::kBearingChannel, bearing.station);
    if (buses_[index]->publish(channel, bearing)) ++sent_;
  }
  std::size_t sent() const { return sent_; }

 private:
  std::vector<std::unique_ptr<ols::LcmBus>> buses_;
  std::int64_t sequence_ = 0;
  std::size_t sent_ = 0;
};

// Unsigned bearings in the stations' names, so that each is looked at by who subscribes to them.
class Attacker {
 public:
  explicit Attacker(const Arguments& arguments)
      : bus_(arguments.url), stations_(arguments.stations) {}
  void send(std::size_t turn) {
    ols_msg::bearing_t bearing{};
    ols::stamp_message(bearing, ols::clock_utime_us(), 666, static_cast<std::int64_t>(turn) + 1);
    bearing.station = ThrowAwaySite::name_of(1 + turn % stations_);
    if (bus_.publish(ols::station_channel(ols::kBearingChannel, bearing.station), bearing)) ++sent_;
  }
  std::size_t sent() const { return sent_; }

 private:
  ols::LcmBus bus_;
  std::size_t stations_, sent_ = 0;
};

// Receives them as the fusion does; its handler only notes when.
class Fusion {
 public:
  Fusion(const Arguments& arguments, const ThrowAwaySite& site)
      : bus_(arguments.url, site.open(kFusion)) {
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

// The least value that this part of them does not exceed; `values` in order.
double quantile(const std::vector<double>& values, double part) {
  if (values.empty()) return NAN;
  const double rank = std::ceil(part * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

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

void print(Phase phase) {
  std::sort(phase.delays_ms.begin(), phase.delays_ms.end());
  std::printf("%9.0f %9zu %9zu %9.3f %9.3f %9.3f %12llu %9llu %9.1f\n", phase.flood_hz, phase.sent,
              phase.delays_ms.size(), quantile(phase.delays_ms, 0.5),
              quantile(phase.delays_ms, 0.99), quantile(phase.delays_ms, 1.0),
              static_cast<unsigned long long>(phase.refused),
              static_cast<unsigned long long>(phase.dropped), resident_mb());
  std::fflush(stdout);
}

std::uint64_t unsigned_of(const ols::BusTraffic& traffic) {
  return traffic.distrusted[static_cast<std::size_t>(trust::Distrust::kUnsigned)];
}

// [Hz] Reached.
double flood(const Arguments& arguments, double rate_hz) {
  if (rate_hz <= 0.0) return 0.0;
  Attacker attacker(arguments);
  const double begin_s = ols::clock_monotonic_s();
  at_rate(rate_hz, arguments.seconds, [&](std::size_t turn) { attacker.send(turn); });
  return static_cast<double>(attacker.sent()) / (ols::clock_monotonic_s() - begin_s);
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
    at_rate(arguments.rate_hz * static_cast<double>(arguments.stations), arguments.seconds,
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
  const ThrowAwaySite site(arguments.stations);
  Fusion fusion(arguments, site);
  Stations stations(arguments, site);
  std::printf("%9s %9s %9s %9s %9s %9s %12s %9s %9s\n", "flood 1/s", "bearings", "heard", "p50 ms",
              "p99 ms", "most ms", "unsigned", "dropped", "MB");
  for (const double flood_hz : {0.0, arguments.flood_hz, 0.0, arguments.flood_hz}) {
    print(measure(arguments, flood_hz, stations, fusion));
  }
}

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("--lcm-url", arguments.url, "the bus")->capture_default_str();
  app.add_option("--stations", arguments.stations)->check(CLI::Range(1, 1000));
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
