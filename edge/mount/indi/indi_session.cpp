#include "edge/mount/indi/indi_session.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "geometry/angles.h"

namespace ols::indi {
namespace {

constexpr double kTurn_s = 0.005;
constexpr double kPatience_s = 10.0;  // for what is needed of a telescope
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

std::string words_of(const std::string& device, const onvif::PtzOptions& options) {
  if (!options.continuous)
    return "INDI " + device + ": takes no track rates, and can only be sent to a place";
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), ": follows at up to %.2f deg/s",
                degrees(options.continuous->x.max));
  return "INDI " + device + text.data();
}

double utc_s(double monotonic_s) {
  return 1e-9 * static_cast<double>(clock_utc_ns()) + monotonic_s - clock_monotonic_s();
}

bool wait_until(const IndiLink& link, mount::SharedDrive& shared, double within_s,
                const std::stop_token& stop, const std::function<bool(const Heard&)>& holds) {
  const double end_s = clock_monotonic_s() + within_s;
  while (clock_monotonic_s() < end_s && !stop.stop_requested()) {
    if (holds(link.heard())) return true;
    shared.pause(kTurn_s, stop);
  }
  return false;
}

}  // namespace

// Until all is known that a station needs of it.
Heard IndiSession::connect(IndiLink& link, mount::SharedDrive& shared,
                           const std::stop_token& stop) {
  link.open();
  const auto need = [&](const char* what, const std::function<bool(const Heard&)>& holds) {
    if (!wait_until(link, shared, kPatience_s, stop, holds) && !stop.stop_requested())
      throw IndiError(what + (": " + link.heard().message));
  };
  need("the server has no such device", [](const Heard& h) { return h.has_device; });
  if (!link.heard().is_connected) link.connect_telescope();
  need("the driver does not reach the telescope", [](const Heard& h) { return h.is_connected; });
  link.set_interval(config_.drive.poll_s);
  need("the telescope reports no position or no place",
       [](const Heard& h) { return h.position && h.observer; });
  // What it can do, it defines in the same breath as its position, in any order.
  wait_until(link, shared, kStops_s, stop,
             [](const Heard& h) { return h.can_stop_tracking && h.fastest_rad_s; });
  if (link.heard().is_parked) {
    link.unpark();
    need("the telescope stays parked", [](const Heard& h) { return !h.is_parked; });
  }
  return link.heard();
}

void IndiSession::run(mount::SharedDrive& shared, device::DeviceThread& thread,
                      const std::stop_token& stop) {
  IndiLink link(config_.host, config_.port, config_.device);
  heard_ = connect(link, shared, stop);
  if (stop.stop_requested()) return;
  const onvif::PtzOptions options = options_of(heard_, config_.drive.limits);
  if (pier_side_.empty()) pier_side_ = heard_.pier_side;
  goes_s_.reset();
  {
    const std::lock_guard lock(shared.mutex);
    shared.drive.connected(options);
    shared.words = words_of(config_.device, options);
  }
  thread.opened();
  serve(link, shared, thread, stop);
  link.stop();
  wait_until(link, shared, kStops_s, {},
             [](const Heard& h) { return h.lost || !(h.tracks || h.slews); });
}

void IndiSession::serve(IndiLink& link, mount::SharedDrive& shared, device::DeviceThread& thread,
                        const std::stop_token& stop) {
  const double began_s = clock_monotonic_s();
  while (!stop.stop_requested()) {
    const Heard now = link.heard();
    const double now_s = clock_monotonic_s();
    if (now.lost) throw IndiError("the INDI server or the driver is gone");
    if (!now.is_connected) throw IndiError("the driver has lost the telescope: " + now.message);
    if (now_s - std::max(began_s, now.position_s) > kPatience_s)
      throw IndiError("the telescope reports no positions");
    onvif::Order order;
    {
      const std::lock_guard lock(shared.mutex);
      if (now.position_s > taken_s_) thread.works();
      judge(now, shared);
      if (!now.is_parked) order = shared.drive.next(now_s);
    }
    if (goes_s_ && !now.slews && now_s - *goes_s_ > kGoToBegins_s) {
      link.stop();  // it would follow the stars from there
      goes_s_.reset();
    }
    if (order.act != onvif::Act::kWait && order.act != onvif::Act::kStatus) {
      carry_out(link, order, now_s);
      const std::lock_guard lock(shared.mutex);
      ++shared.orders;
      shared.drive.done(order, now_s);
    }
    shared.pause(kTurn_s, stop);
  }
}

PanTilt IndiSession::angles_at(double monotonic_s) const {
  const mount::Limits& limits = config_.drive.limits;
  return axes_of(config_.axes, *heard_.position, *heard_.observer, utc_s(monotonic_s),
                 0.5 * (limits.pan_min_rad + limits.pan_max_rad));
}

// The caller holds the mutex.
void IndiSession::judge(const Heard& now, mount::SharedDrive& shared) {
  if (now.orders_refused > heard_.orders_refused)
    shared.drive.failed({onvif::Act::kVelocity, {}}, clock_monotonic_s());
  heard_ = now;
  const bool other_side = now.pier_side != pier_side_;
  shared.usable = !now.is_parked && !other_side;
  shared.last_error = now.message;
  shared.errors = now.orders_refused + now.positions_refused;
  shared.alarms.clear();
  if (now.is_parked) shared.alarms.push_back(alarm::ptu_parked());
  if (other_side) shared.alarms.push_back(alarm::ptu_other_pier_side());
  if (now.position_s <= taken_s_) return;
  taken_s_ = now.position_s;
  const PanTilt angles = angles_at(taken_s_ - config_.drive.positions.delay_s);
  shared.drive.take({angles.pan_rad, angles.tilt_rad, {}, {}}, taken_s_, taken_s_);
}

void IndiSession::carry_out(IndiLink& link, const onvif::Order& order, double now_s) {
  const PanTilt vector{order.vector.x, order.vector.y};
  const bool stands = vector.pan_rad == 0.0 && vector.tilt_rad == 0.0;
  goes_s_.reset();
  if (order.act == onvif::Act::kAbsolute) {
    link.go_to(equatorial_of(config_.axes, vector, *heard_.observer, utc_s(now_s)));
    goes_s_ = now_s;
  } else if (order.act == onvif::Act::kStop || stands) {
    link.stop();
  } else {
    link.track(track_rate_of(config_.axes, angles_at(now_s), vector, *heard_.observer));
  }
}

}  // namespace ols::indi
