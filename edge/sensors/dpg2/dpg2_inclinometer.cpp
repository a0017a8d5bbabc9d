#include "edge/sensors/dpg2/dpg2_inclinometer.h"

#include <mutex>
#include <optional>
#include <stdexcept>
#include <stop_token>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "conditions/printed.h"
#include "edge/device/device_thread.h"
#include "edge/device/reading_queue.h"
#include "edge/sensors/dpg2/dpg2_parser.h"
#include "edge/serial/serial_port.h"
#include "geometry/angles.h"

namespace ols::sensors {

namespace {

constexpr double kRead_s = 0.05;       // between two looks at the stop request
constexpr double kFirstPause_s = 0.2;  // before the port is opened again; doubles
constexpr double kMaxPause_s = 5.0;
constexpr int kStartsBeforeReopening = 3;

std::string in_degrees(const AxisAngles& angles) {
  return printed("x %+.3f, y %+.3f deg", degrees(angles.x_rad), degrees(angles.y_rad));
}

}  // namespace

struct Dpg2Inclinometer::Impl {
  explicit Impl(const Dpg2Config& c)
      : config(c),
        parser(c.range_rad),
        thread({"inclinometer", "is being opened", kFirstPause_s, kMaxPause_s,
                alarm::inclinometer_fails}) {}

  void run(const std::stop_token& stop) {
    serial::SerialPort port(config.device, config.baud,
                            config.even_parity ? serial::Parity::kEven : serial::Parity::kNone);
    thread.opened();
    request_version(port);
    serve(port, stop);
  }

  // Returns when the thread must stop. Throws when the port fails, or when the sensor stays silent
  // though it was started kStartsBeforeReopening times.
  void serve(serial::SerialPort& port, const std::stop_token& stop) {
    start_streaming(port);
    double last_reading_s = clock_monotonic_s();
    int starts = 1;
    while (!stop.stop_requested()) {
      if (receive(port.read(kRead_s))) {
        last_reading_s = clock_monotonic_s();
        thread.works();
        starts = 0;
      } else if (clock_monotonic_s() - last_reading_s > config.stale_s) {
        if (starts >= kStartsBeforeReopening) throw std::runtime_error("sends no readings");
        ++starts;
        last_reading_s = clock_monotonic_s();
        start_streaming(port);  // it may have been stopped, or a power cycle reset it
      }
    }
  }

  void request_version(serial::SerialPort& port) {
    {
      const std::lock_guard lock(mutex);
      parser.expect_version();
    }
    port.write(Dpg2Parser::kAskVersion);
  }

  void start_streaming(serial::SerialPort& port) {
    port.write(Dpg2Parser::kStart);
    const std::lock_guard lock(mutex);
    ++starts_sent;
  }

  // Whether a good reading was among the bytes.
  bool receive(const std::string& bytes) {
    const std::lock_guard lock(mutex);
    const double now_s = clock_monotonic_s();
    const auto pairs = parser.receive(bytes, now_s);
    for (const AxisAngles& pair : pairs) {
      if (!last || pair.x_rad != last->x_rad || pair.y_rad != last->y_rad) changed_s = now_s;
      last = pair;
      readings.add(origin_tilt(config, pair));
    }
    thread.set_fault(fault(now_s));
    return !pairs.empty();
  }

  std::string fault(double now_s) const {
    const double silent_s = now_s - (last ? last->time_s : thread.link().first_opened_s);
    if (silent_s > config.stale_s) {
      return "no reading for " + std::to_string(static_cast<int>(silent_s)) + " s";
    }
    if (last && now_s - changed_s > config.stuck_s) return "stuck at " + in_degrees(*last);
    return {};
  }

  device::DeviceReport report() const {
    const std::lock_guard lock(mutex);
    device::DeviceReport r = thread.report();
    describe(r);
    if (last) {
      r.last_good_s = last->time_s;
      r.readings["inclinometer_x_deg"] = degrees(last->x_rad);
      r.readings["inclinometer_y_deg"] = degrees(last->y_rad);
    }
    const Dpg2Counters& c = parser.counters();
    const std::uint64_t openings = thread.link().openings;
    r.counters = {{"inclinometer_readings", c.readings},
                  {"inclinometer_garbled", c.garbled},
                  {"inclinometer_unpaired", c.unpaired},
                  {"inclinometer_out_of_range", c.out_of_range},
                  {"inclinometer_started", starts_sent},
                  {"inclinometer_reopened", openings > 0 ? openings - 1 : 0}};
    return r;
  }

  void describe(device::DeviceReport& r) const {
    if (r.state == device::DeviceState::kFault) {
      if (!last) r.alarms.push_back(alarm::inclinometer_fails(r.text));
    } else if (r.state == device::DeviceState::kOk && !last) {
      r.state = device::DeviceState::kStarting;
      r.text = "waiting for readings";
    } else if (r.state == device::DeviceState::kOk) {
      r.text = (parser.version().empty() ? "" : parser.version() + ", ") + in_degrees(*last);
    }
  }

  const Dpg2Config config;
  mutable std::mutex mutex;  // of everything below but the thread
  Dpg2Parser parser;
  device::ReadingQueue<TiltReading> readings;
  std::optional<AxisAngles> last;  // the last good pair
  double changed_s = 0.0;          // last time a digit changed
  std::uint64_t starts_sent = 0;
  device::DeviceThread thread;  // last: it uses the rest
};

Dpg2Inclinometer::Dpg2Inclinometer(const Dpg2Config& config)
    : impl_(std::make_unique<Impl>(config)) {
  if (config.device.empty()) return;
  impl_->thread.start([impl = impl_.get()](const std::stop_token& stop) { impl->run(stop); });
}

Dpg2Inclinometer::~Dpg2Inclinometer() = default;

std::vector<TiltReading> Dpg2Inclinometer::take_readings() {
  const std::lock_guard lock(impl_->mutex);
  return impl_->readings.take();
}

device::DeviceReport Dpg2Inclinometer::report() const { return impl_->report(); }

}  // namespace ols::sensors
