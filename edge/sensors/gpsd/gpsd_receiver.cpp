#include "edge/sensors/gpsd/gpsd_receiver.h"

#include <mutex>
#include <optional>
#include <stdexcept>
#include <stop_token>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "conditions/printed.h"
#include "edge/device/device_thread.h"
#include "edge/device/reading_queue.h"
#include "edge/sensors/gpsd/gnss_from_gpsd.h"
#include "edge/sensors/gpsd/gpsd_link.h"

namespace ols::sensors {

namespace {

constexpr double kRead_s = 0.1;        // between two looks at the stop request
constexpr double kFirstPause_s = 0.5;  // before the next connection; doubles
constexpr double kMaxPause_s = 10.0;
constexpr double kReconnectAfterStale = 4.0;  // times stale_s

std::string format(const GnssReading& reading) {
  std::string text = printed("%s, %d satellites", to_string(reading.fix), reading.satellites_used);
  if (reading.fix >= GnssFix::k3D) text += printed(", %.3f m", reading.sd_enu_m.maxCoeff());
  return text;
}

std::string format(GpsdLink::Silence silence) {
  switch (silence) {
    case GpsdLink::Silence::kNoReceiver:
      return "gpsd has no receiver";
    case GpsdLink::Silence::kDeviceMissing:
      return "the receiver's device is missing";
    case GpsdLink::Silence::kReceiverSilent:
      break;
  }
  return "the receiver sends nothing";
}

}  // namespace

struct GpsdReceiver::Impl {
  explicit Impl(const GpsdConfig& c)
      : config(c),
        thread({"gnss", "is being connected", kFirstPause_s, kMaxPause_s, alarm::gnss_fails}) {}

  void run(const std::stop_token& stop) {
    GpsdLink link(config.host, config.port);
    set_silence(GpsdLink::Silence::kReceiverSilent);
    thread.opened();
    serve(link, stop);
  }

  // Returns when the thread must stop. Throws when gpsd has gone, or must open its receiver again.
  void serve(GpsdLink& link, const std::stop_token& stop) {
    GpsdEpochs epochs(config.error_sigmas);
    double last_reading_s = clock_monotonic_s();
    bool was_missing = false;
    while (!stop.stop_requested()) {
      const bool received = link.read(kRead_s);
      const double now_s = clock_monotonic_s();
      if (received) epochs.take(link.data(), now_s);
      const auto readings_now = epochs.take_readings(now_s);
      if (!readings_now.empty()) {
        last_reading_s = now_s;
        thread.works();
      }
      const GpsdLink::Silence cause = link.silence();
      add(readings_now, cause, now_s);
      // gpsd opens a receiver that returns when a client connects; but a client that connects while
      // the receiver is missing makes gpsd 3.22 forget it permanently.
      const bool missing = cause == GpsdLink::Silence::kDeviceMissing;
      was_missing = was_missing || missing;
      const double patience_s =
          was_missing ? config.stale_s : kReconnectAfterStale * config.stale_s;
      if (!missing && now_s - last_reading_s > patience_s) throw std::runtime_error(format(cause));
    }
  }

  void set_silence(GpsdLink::Silence cause) {
    const std::lock_guard lock(mutex);
    silence = cause;
  }

  void add(const std::vector<GnssReading>& readings_now, GpsdLink::Silence cause, double now_s) {
    const std::lock_guard lock(mutex);
    silence = cause;
    for (const GnssReading& reading : readings_now) {
      ++reports;
      last = reading;
      if (is_fix(reading)) {
        ++fixes;
        last_fix_s = reading.time_s;
      }
      readings.add(reading);
    }
    thread.set_fault(fault(now_s));
  }

  bool is_fix(const GnssReading& reading) const { return reading.fix >= config.least_fix; }

  std::string fault(double now_s) const {
    const double silent_s = now_s - (last ? last->time_s : thread.link().first_opened_s);
    if (silent_s > config.stale_s) {
      return format(silence) + " for " + std::to_string(static_cast<int>(silent_s)) + " s";
    }
    if (last && last_fix_s && !is_fix(*last)) return format(*last);
    return {};
  }

  device::DeviceReport report() const {
    const std::lock_guard lock(mutex);
    device::DeviceReport r = thread.report();
    describe(r);
    r.last_good_s = last_fix_s;
    if (last) {
      r.readings["gnss_satellites"] = last->satellites_used;
      if (last->fix >= GnssFix::k3D) r.readings["gnss_sd_m"] = last->sd_enu_m.maxCoeff();
    }
    const std::uint64_t openings = thread.link().openings;
    r.counters = {{"gnss_reports", reports},
                  {"gnss_fixes", fixes},
                  {"gnss_reconnects", openings > 0 ? openings - 1 : 0}};
    return r;
  }

  void describe(device::DeviceReport& r) const {
    if (r.state == device::DeviceState::kFault) {
      if (silence != GpsdLink::Silence::kReceiverSilent) r.state = device::DeviceState::kAbsent;
      if (!last) r.alarms.push_back(alarm::gnss_fails(r.text));
    } else if (r.state == device::DeviceState::kOk) {
      if (!last || !is_fix(*last)) r.state = device::DeviceState::kStarting;
      r.text = last ? format(*last) : "waiting for the receiver";
    }
  }

  const GpsdConfig config;
  mutable std::mutex mutex;  // of everything below but the thread
  device::ReadingQueue<GnssReading> readings;
  std::optional<GnssReading> last;
  std::optional<double> last_fix_s;
  GpsdLink::Silence silence = GpsdLink::Silence::kReceiverSilent;  // the cause of a silence
  std::uint64_t reports = 0, fixes = 0;
  device::DeviceThread thread;  // last: it uses the rest
};

GpsdReceiver::GpsdReceiver(const GpsdConfig& config) : impl_(std::make_unique<Impl>(config)) {
  if (config.host.empty()) return;
  impl_->thread.start([impl = impl_.get()](const std::stop_token& stop) { impl->run(stop); });
}

GpsdReceiver::~GpsdReceiver() = default;

std::vector<GnssReading> GpsdReceiver::take_readings() {
  const std::lock_guard lock(impl_->mutex);
  return impl_->readings.take();
}

device::DeviceReport GpsdReceiver::report() const { return impl_->report(); }

}  // namespace ols::sensors
