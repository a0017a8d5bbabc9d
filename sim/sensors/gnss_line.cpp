#include "sim/sensors/gnss_line.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/process/clocks.h"
#include "sim/network/garble.h"
#include "sim/sensors/nmea.h"

namespace ols::sim {

namespace {

constexpr double kLongestSleep_s = 0.02;  // so that it ends promptly
constexpr double kWander_s = 60.0;

}  // namespace

GnssLine::GnssLine(const GnssLineConfig& config, std::function<std::int64_t()> utime_us,
                   std::uint64_t seed, const std::string& link)
    : config_(config),
      utime_us_(std::move(utime_us)),
      frame_(config.antenna),
      sd_enu_m_(config.sd_horizontal_m, config.sd_horizontal_m, config.sd_up_m),
      random_(seed),
      error_enu_m_(sd_enu_m_.cwiseProduct(normals())),
      pty_(link),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void GnssLine::run(const std::stop_token& stop) {
  double next_s = clock_monotonic_s();
  while (!stop.stop_requested()) {
    pty_.wait(std::clamp(next_s - clock_monotonic_s(), 0.0, kLongestSleep_s));
    static_cast<void>(pty_.read());  // it ignores all commands
    if (clock_monotonic_s() < next_s) continue;
    next_s = std::max(next_s + 1.0 / config_.rate_hz, clock_monotonic_s());
    send_epoch();
  }
}

void GnssLine::send_epoch() {
  const GnssFaults now = current_faults();
  wander();
  if (now.silent) return;
  NmeaEpoch epoch;
  // The receiver's epochs are at whole hundredths.
  epoch.utime_us = utime_us_() / 10'000 * 10'000;
  epoch.has_fix = !now.no_fix;
  epoch.quality = config_.quality;
  epoch.geoid_m = config_.geoid_m;
  epoch.sd_enu_m = sd_enu_m_;
  epoch.antenna =
      geodetic_from_ecef(frame_.to_ecef(error_enu_m_ + Eigen::Vector3d(now.jump_m, 0.0, 0.0)));
  pty_.write(spoilt(nmea_epoch(epoch), now.garble_share));
}

void GnssLine::wander() {
  const double kept = std::exp(-1.0 / (config_.rate_hz * kWander_s));
  error_enu_m_ =
      kept * error_enu_m_ + std::sqrt(1.0 - kept * kept) * sd_enu_m_.cwiseProduct(normals());
}

std::string GnssLine::spoilt(const std::string& sentences, double share) {
  std::string out;
  for (std::size_t at = 0; at < sentences.size();) {
    const std::size_t end = std::min(sentences.find('\n', at), sentences.size() - 1) + 1;
    std::string sentence = sentences.substr(at, end - at);
    if (std::uniform_real_distribution<double>()(random_) < share) {
      spoil_one_byte(sentence, random_);
    }
    out += sentence;
    at = end;
  }
  return out;
}

Eigen::Vector3d GnssLine::normals() {
  Eigen::Vector3d out;
  for (double& axis : out) axis = normal_(random_);
  return out;
}

GnssFaults GnssLine::current_faults() {
  const std::lock_guard lock(mutex_);
  return faults_;
}

void GnssLine::set_faults(const GnssFaults& faults) {
  const std::lock_guard lock(mutex_);
  faults_ = faults;
}

}  // namespace ols::sim
