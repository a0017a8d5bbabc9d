#include "edge/mount/indi/indi_mount.h"

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <stop_token>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "edge/device/device_thread.h"
#include "edge/mount/indi/indi_link.h"
#include "geometry/angles.h"

namespace ols::indi {
namespace {

constexpr double kFirstPause_s = 0.2, kMaxPause_s = 5.0;
constexpr double kTurn_s = 0.005;
constexpr double kPatience_s = 10.0;  // for what is needed of a telescope
constexpr double kNoAngles_s = 1.0;   // without a position: an alarm
constexpr double kGoToBegins_s = 1.0;
constexpr double kStops_s = 1.0;                   // for a stop at the end
constexpr double kLeastRate_rad_s = radians(0.1);  // a slower telescope cannot follow anything

// In radians. A telescope that takes rates is steered by them, any other by ordered positions.
onvif::PtzOptions options_of(const Heard& heard, const mount::Limits& limits) {
  onvif::PtzOptions options;
  const double fastest = heard.fastest_rad_s.value_or(0.0);
  if (heard.can_stop_tracking && fastest >= kLeastRate_rad_s) {
    options.continuous = onvif::Space{"", {-fastest, fastest}, {-fastest, fastest}};
  } else {
    options.absolute = onvif::Space{
        "", {limits.pan_min_rad, limits.pan_max_rad}, {limits.tilt_min_rad, limits.tilt_max_rad}};
  }
  return options;
}

double middle_of(const mount::Limits& limits) {
  return 0.5 * (limits.pan_min_rad + limits.pan_max_rad);
}

std::string words_of(const std::string& device, const onvif::PtzOptions& options) {
  std::array<char, 80> text{};
  if (options.continuous) {
    std::snprintf(text.data(), text.size(), ": follows at up to %.2f deg/s",
                  degrees(options.continuous->x.max));
    return "INDI " + device + text.data();
  }
  return "INDI " + device + ": takes no track rates, and can only be sent to a place";
}

}  // namespace

struct IndiMount::Impl {
  explicit Impl(const IndiConfig& wanted)
      : config(wanted),
        drive(wanted.drive),
        thread(
            {"ptu", "is being connected", kFirstPause_s, kMaxPause_s, alarm::ptu_no_connection}) {
    thread.start([this](const std::stop_token& stop) { run(stop); });
  }

  void run(const std::stop_token& stop);
  Heard connect(IndiLink& link, const std::stop_token& stop);
  void serve(IndiLink& link, const std::stop_token& stop);
  void take(const Heard& heard);
  void carry_out(IndiLink& link, const onvif::Order& order, double now_s);
  bool wait_until(const IndiLink& link, double within_s, const std::stop_token& stop,
                  const std::function<bool(const Heard&)>& holds);
  void pause(const std::stop_token& stop);
  bool ready() const;
  double utc_s(double monotonic_s) const;

  const IndiConfig config;
  mutable std::mutex mutex;  // of all below but the thread
  std::condition_variable_any wake;
  onvif::Drive drive;
  std::string words, pier_side;
  Heard heard;
  double taken_s = 0.0;      // the newest position that the drive has
  double go_to_s = -1e9;     // when a slew was ordered
  bool goes = false;         // it is under way
  std::uint64_t orders = 0;  // sent
  std::uint64_t refused = 0;
  device::DeviceThread thread;  // last: it uses the rest
};

void IndiMount::Impl::pause(const std::stop_token& stop) {
  std::unique_lock lock(mutex);
  wake.wait_for(lock, stop, std::chrono::duration<double>(kTurn_s), [] { return false; });
}

bool IndiMount::Impl::wait_until(const IndiLink& link, double within_s, const std::stop_token& stop,
                                 const std::function<bool(const Heard&)>& holds) {
  const double end_s = clock_monotonic_s() + within_s;
  while (clock_monotonic_s() < end_s && !stop.stop_requested()) {
    if (holds(link.heard())) return true;
    pause(stop);
  }
  return false;
}

double IndiMount::Impl::utc_s(double monotonic_s) const {
  return 1e-9 * static_cast<double>(clock_utc_ns()) + monotonic_s - clock_monotonic_s();
}

// Until all is known that a station needs of it.
Heard IndiMount::Impl::connect(IndiLink& link, const std::stop_token& stop) {
  link.open();
  const auto need = [&](const char* what, const std::function<bool(const Heard&)>& holds) {
    if (!wait_until(link, kPatience_s, stop, holds) && !stop.stop_requested())
      throw IndiError(what + (": " + link.heard().message));
  };
  need("the server has no such device", [](const Heard& h) { return h.has_device; });
  if (!link.heard().is_connected) link.connect_telescope();
  need("the driver does not reach the telescope", [](const Heard& h) { return h.is_connected; });
  link.set_interval(config.drive.poll_s);
  need("the telescope reports no position or no place",
       [](const Heard& h) { return h.position && h.observer; });
  // What it can do, it defines in the same breath as its position, in any order.
  wait_until(link, kStops_s, stop,
             [](const Heard& h) { return h.can_stop_tracking && h.fastest_rad_s; });
  if (link.heard().is_parked) {
    link.unpark();
    need("the telescope stays parked", [](const Heard& h) { return !h.is_parked; });
  }
  return link.heard();
}

void IndiMount::Impl::run(const std::stop_token& stop) {
  IndiLink link(config.host, config.port, config.device);
  const struct Lost {
    Impl& impl;
    ~Lost() {
      const std::lock_guard lock(impl.mutex);
      impl.drive.lost();
    }
  } lost{*this};
  const Heard learnt = connect(link, stop);
  if (stop.stop_requested()) return;
  {
    const std::lock_guard lock(mutex);
    const onvif::PtzOptions options = options_of(learnt, config.drive.limits);
    drive.connected(options);
    words = words_of(config.device, options);
    if (pier_side.empty()) pier_side = learnt.pier_side;
    goes = false;
  }
  thread.opened();
  serve(link, stop);
  link.stop();
  wait_until(link, kStops_s, {}, [](const Heard& h) { return h.lost || !(h.tracks || h.slews); });
}

void IndiMount::Impl::serve(IndiLink& link, const std::stop_token& stop) {
  const double began_s = clock_monotonic_s();
  while (!stop.stop_requested()) {
    const Heard now = link.heard();
    const double now_s = clock_monotonic_s();
    if (now.lost) throw IndiError("the INDI server or the driver is gone");
    if (!now.is_connected) throw IndiError("the driver has lost the telescope: " + now.message);
    if (now_s - std::max(began_s, now.position_s) > kPatience_s)
      throw IndiError("the telescope reports no positions");
    std::unique_lock lock(mutex);
    take(now);
    const onvif::Order order = now.is_parked ? onvif::Order{} : drive.next(now_s);
    const bool arrived = goes && !now.slews && now_s - go_to_s > kGoToBegins_s;
    if (arrived) goes = false;
    lock.unlock();
    if (arrived) link.stop();  // it would follow the stars from there
    carry_out(link, order, now_s);
    pause(stop);
  }
}

// To be called with the mutex.
void IndiMount::Impl::take(const Heard& now) {
  if (now.orders_refused > heard.orders_refused)
    drive.failed({onvif::Act::kVelocity, {}}, clock_monotonic_s());
  heard = now;
  if (heard.position_s <= taken_s) return;
  taken_s = heard.position_s;
  const double seen_s = taken_s - config.drive.positions.delay_s;
  const PanTilt angles = axes_of(config.axes, *heard.position, *heard.observer, utc_s(seen_s),
                                 middle_of(config.drive.limits));
  drive.take({angles.pan_rad, angles.tilt_rad, {}, {}}, taken_s, taken_s);
  thread.works();
}

void IndiMount::Impl::carry_out(IndiLink& link, const onvif::Order& order, double now_s) {
  if (order.act == onvif::Act::kWait || order.act == onvif::Act::kStatus) return;
  const PanTilt vector{order.vector.x, order.vector.y};
  const bool stands = vector.pan_rad == 0.0 && vector.tilt_rad == 0.0;
  if (order.act == onvif::Act::kAbsolute) {
    link.go_to(equatorial_of(config.axes, vector, *heard.observer, utc_s(now_s)));
  } else if (order.act == onvif::Act::kStop || stands) {
    link.stop();
  } else {
    const PanTilt angles = axes_of(config.axes, *heard.position, *heard.observer, utc_s(now_s),
                                   middle_of(config.drive.limits));
    link.track(track_rate_of(config.axes, angles, vector, *heard.observer));
  }
  const std::lock_guard lock(mutex);
  ++orders;
  goes = order.act == onvif::Act::kAbsolute;
  if (goes) go_to_s = now_s;
  drive.done(order, now_s);
}

bool IndiMount::Impl::ready() const {
  return drive.has_position() && thread.link().is_open && !heard.is_parked &&
         heard.pier_side == pier_side;
}

IndiMount::IndiMount(const IndiConfig& config) : impl_(std::make_unique<Impl>(config)) {}
IndiMount::~IndiMount() = default;

void IndiMount::set_goal(const std::optional<mount::Goal>& goal) {
  const std::lock_guard lock(impl_->mutex);
  impl_->drive.set_goal(impl_->ready() ? goal : std::nullopt);
}

std::vector<mount::AngleSample> IndiMount::take_samples() {
  const std::lock_guard lock(impl_->mutex);
  auto samples = impl_->drive.take_samples();
  if (!impl_->ready()) samples.clear();
  return samples;
}

std::optional<mount::Limits> IndiMount::limits() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->ready() ? std::optional(impl_->drive.limits()) : std::nullopt;
}

void IndiMount::emergency_halt() {
  const std::lock_guard lock(impl_->mutex);
  impl_->drive.emergency_halt();
  impl_->wake.notify_all();
}

void IndiMount::clear_emergency() {
  const std::lock_guard lock(impl_->mutex);
  impl_->drive.clear_emergency();
}

mount::Reference IndiMount::reference() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->ready() ? mount::Reference::kTrusted : mount::Reference::kUnknown;
}

device::DeviceReport IndiMount::report() const {
  const Impl& impl = *impl_;
  device::DeviceReport report = impl.thread.report();
  const double now_s = clock_monotonic_s();
  const std::lock_guard lock(impl.mutex);
  report.last_good_s = impl.drive.last_position_s();
  for (Alarm& alarm : impl.drive.alarms(now_s)) report.alarms.push_back(std::move(alarm));
  if (report.state == device::DeviceState::kOk) {
    report.text = impl.words;
    if (now_s - report.last_good_s.value_or(0.0) > kNoAngles_s)
      report.alarms.push_back(alarm::ptu_no_angles());
    if (impl.heard.is_parked) report.alarms.push_back(alarm::ptu_parked());
    if (impl.heard.pier_side != impl.pier_side)
      report.alarms.push_back(alarm::ptu_other_pier_side());
    if (!impl.ready()) report.state = device::DeviceState::kFault;
  }
  if (!impl.heard.message.empty()) report.last_error = impl.heard.message;
  const onvif::PositionIntake& intake = impl.drive.intake();
  report.readings = {{"ptu_position_sd_deg", degrees(intake.sd_rad())}};
  if (intake.interval_s() > 0.0) report.readings["ptu_interval_s"] = intake.interval_s();
  const onvif::Drive::Counters& seen = impl.drive.counters();
  report.counters = {{"ptu_requests", impl.orders},
                     {"ptu_errors", impl.heard.orders_refused + impl.heard.positions_refused},
                     {"ptu_emergencies", seen.emergencies},
                     {"ptu_stops_repeated", seen.stops_repeated},
                     {"ptu_unordered_motions", seen.unordered_motions},
                     {"ptu_orders_ignored", seen.orders_ignored},
                     {"ptu_port_failures", impl.thread.link().failures}};
  return report;
}

}  // namespace ols::indi
