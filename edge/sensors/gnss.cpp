#include "edge/sensors/gnss.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <thread>
#include <utility>

#include "base/clocks.h"
#include "edge/sensors/gnss_from_gpsd.h"
#include "edge/sensors/gpsd_link.h"

namespace ols {

namespace {

constexpr double kRead_s = 0.1;        // so that an end is noticed
constexpr double kFirstPause_s = 0.5;  // before the next connection; doubles
constexpr double kLongestPause_s = 10.0;
constexpr double kReconnectAfterStale = 4.0;  // times stale_s
constexpr std::size_t kMostReadings = 1000;   // kept for a caller that does not come

std::string in_words(const GnssReading& reading) {
  char text[96];
  if (reading.fix >= GnssFix::k3D) {
    std::snprintf(text, sizeof text, "%s, %d satellites, %.3f m", to_string(reading.fix),
                  reading.satellites_used, reading.sd_enu_m.maxCoeff());
  } else {
    std::snprintf(text, sizeof text, "%s, %d satellites", to_string(reading.fix),
                  reading.satellites_used);
  }
  return text;
}

std::string in_words(GpsdLink::Silence silence) {
  switch (silence) {
    case GpsdLink::Silence::kNoReceiver:
      return "gpsd has no receiver";
    case GpsdLink::Silence::kDeviceMissing:
      return "the receiver's device is not there";
    case GpsdLink::Silence::kReceiverSilent:
      break;
  }
  return "the receiver says nothing";
}

}  // namespace

struct Gnss::Impl {
  explicit Impl(const GnssConfig& c) : config(c) {}

  void run(const std::stop_token& stop) {
    double pause_s = kFirstPause_s;
    while (!stop.stop_requested()) {
      try {
        GpsdLink link(config.host, config.port);
        note_connected();
        serve(link, stop, pause_s);
      } catch (const std::exception& failure) {
        note_failure(failure.what());
        std::unique_lock lock(mutex);
        wake.wait_for(lock, stop, std::chrono::duration<double>(pause_s), [] { return false; });
        pause_s = std::min(2.0 * pause_s, kLongestPause_s);
      }
    }
  }

  // Until gpsd has gone, or is to open its receiver anew, which throws, or the thread is to stop.
  void serve(GpsdLink& link, const std::stop_token& stop, double& pause_s) {
    GpsdEpochs epochs(config.error_sigmas);
    double heard_s = clock_monotonic_s();
    bool was_missing = false;
    while (!stop.stop_requested()) {
      const bool came = link.read(kRead_s);
      const double now_s = clock_monotonic_s();
      if (came) epochs.take(link.data(), now_s);
      const auto fresh = epochs.take_readings(now_s);
      if (!fresh.empty()) {
        heard_s = now_s;
        pause_s = kFirstPause_s;
      }
      const GpsdLink::Silence cause = link.silence();
      take(fresh, cause, now_s);
      // gpsd opens a receiver that had gone when a client comes; but a client that comes while it
      // is away makes gpsd forget it for good (3.22).
      const bool missing = cause == GpsdLink::Silence::kDeviceMissing;
      was_missing = was_missing || missing;
      const double patience_s = was_missing ? 0.0 : kReconnectAfterStale * config.stale_s;
      if (!missing && now_s - heard_s > std::max(patience_s, config.stale_s)) {
        throw std::runtime_error(in_words(cause));
      }
    }
  }

  void take(const std::vector<GnssReading>& fresh, GpsdLink::Silence cause, double now_s) {
    const std::lock_guard lock(mutex);
    silence = cause;
    for (const GnssReading& reading : fresh) {
      ++reports;
      if (reading.fix >= config.least_fix) ++fixes;
      last = reading;
      if (reading.fix >= config.least_fix) last_fix_s = reading.time_s;
      if (readings.size() == kMostReadings) readings.erase(readings.begin());
      readings.push_back(reading);
    }
    note_new_troubles(now_s);
  }

  // A trouble is counted when it begins.
  void note_new_troubles(double now_s) {
    const std::string now = trouble_in_words(now_s);
    if (!now.empty() && trouble.empty()) {
      ++errors;
      last_error = now;
    }
    trouble = now;
  }

  std::string trouble_in_words(double now_s) const {
    const double silent_s = now_s - (last ? last->time_s : first_connected_s);
    if (silent_s > config.stale_s) {
      return in_words(silence) + " for " + std::to_string(static_cast<int>(silent_s)) + " s";
    }
    if (last && last_fix_s && last->fix < config.least_fix) return in_words(*last);
    return {};
  }

  void note_connected() {
    const std::lock_guard lock(mutex);
    if (ever_connected) {
      ++reconnects;
    } else {
      first_connected_s = clock_monotonic_s();
    }
    connected = ever_connected = true;
    silence = GpsdLink::Silence::kReceiverSilent;
  }

  void note_failure(const std::string& what) {
    const std::lock_guard lock(mutex);
    connected = false;
    ++errors;
    last_error = link_error = what;
  }

  DeviceReport report() const {
    const std::lock_guard lock(mutex);
    DeviceReport r;
    r.name = "gnss";
    describe(r);
    r.last_error = last_error;
    r.errors = errors;
    r.last_good_s = last_fix_s;
    if (last) {
      r.readings["gnss_satellites"] = last->satellites_used;
      if (last->fix >= GnssFix::k3D) r.readings["gnss_sd_m"] = last->sd_enu_m.maxCoeff();
    }
    r.counters = {
        {"gnss_reports", reports}, {"gnss_fixes", fixes}, {"gnss_reconnects", reconnects}};
    return r;
  }

  void describe(DeviceReport& r) const {
    if (config.host.empty()) {
      r.text = "not configured";
      return;
    }
    if (!connected) {
      r.state = errors > 0 ? DeviceState::kAbsent : DeviceState::kStarting;
      r.text = errors > 0 ? link_error : "is being connected";
      if (errors > 0) r.alarms.push_back("gnss: " + link_error);
      return;
    }
    if (!trouble.empty()) {
      const bool is_there = silence == GpsdLink::Silence::kReceiverSilent;
      r.state = is_there ? DeviceState::kFault : DeviceState::kAbsent;
      r.text = trouble;
      if (!last) r.alarms.push_back("gnss: " + trouble);
    } else if (!last || last->fix < config.least_fix) {
      r.state = DeviceState::kStarting;
      r.text = last ? in_words(*last) : "waiting for the receiver";
    } else {
      r.state = DeviceState::kOk;
      r.text = in_words(*last);
    }
  }

  const GnssConfig config;
  mutable std::mutex mutex;  // of everything below
  std::condition_variable_any wake;
  std::vector<GnssReading> readings;
  std::optional<GnssReading> last;
  std::optional<double> last_fix_s;
  bool connected = false, ever_connected = false;
  GpsdLink::Silence silence = GpsdLink::Silence::kReceiverSilent;  // why, when there is silence
  double first_connected_s = 0.0;
  std::uint64_t reports = 0, fixes = 0, reconnects = 0, errors = 0;
  std::string link_error, last_error;
  std::string trouble;  // what is wrong now, as the thread last saw it
  std::jthread thread;  // last: it uses the rest
};

Gnss::Gnss(const GnssConfig& config) : impl_(std::make_unique<Impl>(config)) {
  if (config.host.empty()) return;
  impl_->thread = std::jthread([this](const std::stop_token& stop) { impl_->run(stop); });
}

Gnss::~Gnss() = default;  // the jthread asks to stop and joins

std::vector<GnssReading> Gnss::take_readings() {
  const std::lock_guard lock(impl_->mutex);
  return std::exchange(impl_->readings, {});
}

DeviceReport Gnss::report() const { return impl_->report(); }

}  // namespace ols
