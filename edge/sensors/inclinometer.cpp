#include "edge/sensors/inclinometer.h"

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
#include "edge/ptu/serial_port.h"
#include "geometry/angles.h"

namespace ols {

namespace {

constexpr double kRead_s = 0.05;       // so that an end is noticed
constexpr double kFirstPause_s = 0.2;  // before the port is opened again; doubles
constexpr double kLongestPause_s = 5.0;
constexpr int kStartsBeforeReopening = 3;
constexpr std::size_t kMostReadings = 1000;  // kept for a caller that does not come

std::string in_degrees(const AxisAngles& angles) {
  char text[64];
  std::snprintf(text, sizeof text, "x %+.3f, y %+.3f deg", degrees(angles.x_rad),
                degrees(angles.y_rad));
  return text;
}

}  // namespace

struct Inclinometer::Impl {
  explicit Impl(const InclinometerConfig& c) : config(c), parser(c.range_rad) {}

  void run(const std::stop_token& stop) {
    double pause_s = kFirstPause_s;
    while (!stop.stop_requested()) {
      try {
        SerialPort port(config.device, config.baud,
                        config.even_parity ? Parity::kEven : Parity::kNone);
        note_open();
        serve(port, stop, pause_s);
      } catch (const std::exception& failure) {
        note_failure(failure.what());
        std::unique_lock lock(mutex);
        wake.wait_for(lock, stop, std::chrono::duration<double>(pause_s), [] { return false; });
        pause_s = std::min(2.0 * pause_s, kLongestPause_s);
      }
    }
  }

  // Until the port fails or nothing helps against silence, which throws, or the thread is to stop.
  void serve(SerialPort& port, const std::stop_token& stop, double& pause_s) {
    port.write("V");
    start_streaming(port);
    double heard_s = clock_monotonic_s();
    int starts = 1;
    while (!stop.stop_requested()) {
      if (receive(port.read(kRead_s))) {
        heard_s = clock_monotonic_s();
        pause_s = kFirstPause_s;
        starts = 0;
      } else if (clock_monotonic_s() - heard_s > config.stale_s) {
        if (starts >= kStartsBeforeReopening) throw std::runtime_error("sends no readings");
        ++starts;
        heard_s = clock_monotonic_s();
        start_streaming(port);  // it may have been stopped, or come back without its setting
      }
    }
  }

  void start_streaming(SerialPort& port) {
    port.write("S");
    const std::lock_guard lock(mutex);
    ++starts_sent;
  }

  // Whether a good reading was among the bytes.
  bool receive(const std::string& bytes) {
    const std::lock_guard lock(mutex);
    const double now_s = clock_monotonic_s();
    const auto pairs = parser.receive(bytes, now_s);
    for (const AxisAngles& pair : pairs) {
      if (!shown || pair.x_rad != shown->x_rad || pair.y_rad != shown->y_rad) changed_s = now_s;
      shown = pair;
      if (readings.size() == kMostReadings) readings.erase(readings.begin());
      readings.push_back(origin_tilt(config, pair));
    }
    note_new_troubles(now_s);
    return !pairs.empty();
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
    const double silent_s = now_s - (shown ? shown->time_s : first_opened_s);
    if (silent_s > config.stale_s) {
      return "no reading for " + std::to_string(static_cast<int>(silent_s)) + " s";
    }
    const double unchanged_s = now_s - changed_s;
    if (shown && unchanged_s > config.stuck_s) {
      return "stuck at " + in_degrees(*shown);
    }
    return {};
  }

  void note_open() {
    const std::lock_guard lock(mutex);
    if (ever_open) {
      ++reopened;
    } else {
      first_opened_s = clock_monotonic_s();
    }
    open = ever_open = true;
    parser.expect_version();
  }

  void note_failure(const std::string& what) {
    const std::lock_guard lock(mutex);
    open = false;
    ++errors;
    last_error = port_error = what;
  }

  DeviceReport report() const {
    const std::lock_guard lock(mutex);
    DeviceReport r;
    r.name = "inclinometer";
    describe(r);
    r.last_error = last_error;
    r.errors = errors;
    if (shown) {
      r.last_good_s = shown->time_s;
      r.readings["inclinometer_x_deg"] = degrees(shown->x_rad);
      r.readings["inclinometer_y_deg"] = degrees(shown->y_rad);
    }
    const Dpg2Counters& c = parser.counters();
    r.counters = {
        {"inclinometer_readings", c.readings}, {"inclinometer_garbled", c.garbled},
        {"inclinometer_unpaired", c.unpaired}, {"inclinometer_out_of_range", c.out_of_range},
        {"inclinometer_started", starts_sent}, {"inclinometer_reopened", reopened}};
    return r;
  }

  void describe(DeviceReport& r) const {
    if (config.device.empty()) {
      r.text = "not configured";
      return;
    }
    if (!open) {
      r.state = errors > 0 ? DeviceState::kAbsent : DeviceState::kStarting;
      r.text = errors > 0 ? port_error : "is being opened";
      if (errors > 0) r.alarms.push_back("inclinometer: " + port_error);
      return;
    }
    if (!trouble.empty()) {
      r.state = DeviceState::kFault;
      r.text = trouble;
      if (!shown) r.alarms.push_back("inclinometer: " + trouble);
    } else if (!shown) {
      r.state = DeviceState::kStarting;
      r.text = "waiting for readings";
    } else {
      r.state = DeviceState::kOk;
      r.text = in_degrees(*shown);
      if (!parser.version().empty()) r.text = parser.version() + ", " + r.text;
    }
  }

  const InclinometerConfig config;
  mutable std::mutex mutex;  // of everything below
  std::condition_variable_any wake;
  Dpg2Parser parser;
  std::vector<TiltReading> readings;
  std::optional<AxisAngles> shown;  // the last good pair
  double changed_s = 0.0;           // last time a digit changed
  double first_opened_s = 0.0;
  bool open = false, ever_open = false;
  std::uint64_t reopened = 0, starts_sent = 0, errors = 0;
  std::string port_error, last_error;
  std::string trouble;  // what is wrong now, as the thread last saw it
  std::jthread thread;  // last: it uses the rest
};

Inclinometer::Inclinometer(const InclinometerConfig& config)
    : impl_(std::make_unique<Impl>(config)) {
  if (config.device.empty()) return;
  impl_->thread = std::jthread([this](const std::stop_token& stop) { impl_->run(stop); });
}

Inclinometer::~Inclinometer() = default;  // the jthread asks to stop and joins

std::vector<TiltReading> Inclinometer::take_readings() {
  const std::lock_guard lock(impl_->mutex);
  return std::exchange(impl_->readings, {});
}

DeviceReport Inclinometer::report() const { return impl_->report(); }

}  // namespace ols
