#include "sim/sensors/gnss_line.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <random>
#include <stop_token>
#include <thread>
#include <utility>

#include "base/process/clocks.h"
#include "sim/network/garble.h"
#include "sim/sensors/nmea.h"
#include "sim/serial/pty.h"

namespace ols::sim {

namespace {

constexpr double kLongestSleep_s = 0.02;  // so that it ends promptly
constexpr double kWander_s = 60.0;

}  // namespace

struct GnssLine::Impl {
  Impl(const GnssLineConfig& c, std::function<std::int64_t()> utime, std::uint64_t seed,
       const std::string& link)
      : config(c),
        utime_us(std::move(utime)),
        frame(c.antenna),
        sd_enu_m(c.sd_horizontal_m, c.sd_horizontal_m, c.sd_up_m),
        random(seed),
        pty(link),
        device(pty.device()) {
    error_enu_m = sd_enu_m.cwiseProduct(normals());
    thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  void run(const std::stop_token& stop) {
    double next_s = clock_monotonic_s();
    while (!stop.stop_requested()) {
      pty.wait(std::clamp(next_s - clock_monotonic_s(), 0.0, kLongestSleep_s));
      static_cast<void>(pty.read());  // it ignores all commands
      if (clock_monotonic_s() < next_s) continue;
      next_s = std::max(next_s + 1.0 / config.rate_hz, clock_monotonic_s());
      send_epoch();
    }
  }

  void send_epoch() {
    const GnssFaults now = current_faults();
    wander();
    if (now.silent) return;
    NmeaEpoch epoch;
    // The receiver's epochs are at whole hundredths.
    epoch.utime_us = utime_us() / 10'000 * 10'000;
    epoch.has_fix = !now.no_fix;
    epoch.quality = config.quality;
    epoch.geoid_m = config.geoid_m;
    epoch.sd_enu_m = sd_enu_m;
    epoch.antenna =
        geodetic_from_ecef(frame.to_ecef(error_enu_m + Eigen::Vector3d(now.jump_m, 0.0, 0.0)));
    pty.write(spoilt(nmea_epoch(epoch), now.garble_share));
  }

  // First-order Gauss-Markov process.
  void wander() {
    const double kept = std::exp(-1.0 / (config.rate_hz * kWander_s));
    error_enu_m =
        kept * error_enu_m + std::sqrt(1.0 - kept * kept) * sd_enu_m.cwiseProduct(normals());
  }

  std::string spoilt(const std::string& sentences, double share) {
    std::string out;
    for (std::size_t at = 0; at < sentences.size();) {
      const std::size_t end = std::min(sentences.find('\n', at), sentences.size() - 1) + 1;
      std::string sentence = sentences.substr(at, end - at);
      if (std::uniform_real_distribution<double>()(random) < share) {
        spoil_one_byte(sentence, random);
      }
      out += sentence;
      at = end;
    }
    return out;
  }

  Eigen::Vector3d normals() {
    Eigen::Vector3d out;
    for (double& axis : out) axis = normal(random);
    return out;
  }

  GnssFaults current_faults() {
    const std::lock_guard lock(mutex);
    return faults;
  }

  const GnssLineConfig config;
  const std::function<std::int64_t()> utime_us;
  const LocalFrame frame;
  const Eigen::Vector3d sd_enu_m;
  std::mutex mutex;  // for faults
  GnssFaults faults;
  std::mt19937_64 random;
  std::normal_distribution<double> normal;
  Eigen::Vector3d error_enu_m;
  Pty pty;
  std::string device;
  std::jthread thread;  // last: it uses the rest
};

GnssLine::GnssLine(const GnssLineConfig& config, std::function<std::int64_t()> utime_us,
                   std::uint64_t seed, const std::string& link)
    : impl_(std::make_unique<Impl>(config, std::move(utime_us), seed, link)) {}

GnssLine::~GnssLine() = default;

const std::string& GnssLine::device() const { return impl_->device; }

void GnssLine::set_faults(const GnssFaults& faults) {
  const std::lock_guard lock(impl_->mutex);
  impl_->faults = faults;
}

}  // namespace ols::sim
