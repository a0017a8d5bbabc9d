#include "edge/mount/indi/indi_session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "geometry/angles.h"

namespace ols::indi {
namespace {

constexpr double kTurn_s = 0.005;
constexpr double kPatience_s = 10.0;  // until all that is needed of a telescope is known
constexpr double kGoToBegins_s = 1.0;
constexpr double kStops_s = 1.0;                   // for a stop at the end
constexpr double kLeastRate_rad_s = radians(0.1);  // a slower telescope cannot follow anything

// In radians. A telescope that takes rates is steered by them, any other by ordered positions.
mount::Moves moves_of(const Heard& heard, const mount::Limits& limits) {
  mount::Moves moves;
  const double fastest = heard.fastest_rad_s.value_or(0.0);
  if (heard.can_stop_tracking && fastest >= kLeastRate_rad_s) {
    moves.continuous = mount::Space{{-fastest, fastest}, {-fastest, fastest}};
  } else {
    moves.absolute = mount::Space{{limits.pan_min_rad, limits.pan_max_rad},
                                  {limits.tilt_min_rad, limits.tilt_max_rad}};
  }
  return moves;
}

std::string words_of(const std::string& device, const mount::Moves& moves) {
  if (!moves.continuous)
    return "INDI " + device + ": takes no track rates, and can only be sent to a place";
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), ": follows at up to %.2f deg/s",
                degrees(moves.continuous->x.max));
  return "INDI " + device + text.data();
}

// In the same direction, no faster than the telescope takes.
TrackRate within(TrackRate rate, double fastest_rad_s) {
  const double fastest = std::max(std::abs(rate.hour_angle_rad_s), std::abs(rate.dec_rad_s));
  const double share = fastest > fastest_rad_s ? fastest_rad_s / fastest : 1.0;
  return {share * rate.hour_angle_rad_s, share * rate.dec_rad_s};
}

double utc_s(double monotonic_s) {
  return 1e-9 * static_cast<double>(clock_utc_ns()) + monotonic_s - clock_monotonic_s();
}

bool is_put_away(const Heard& heard) { return heard.is_parked || heard.parks; }

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

// Returns when all is known that a station needs of the telescope.
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
  // A driver announces together, in any order, what the telescope can do and whether it is parked.
  wait_until(link, shared, kStops_s, stop,
             [](const Heard& h) { return h.can_stop_tracking && h.fastest_rad_s; });
  if (!is_put_away(link.heard())) link.stop();
  link.set_interval(config_.drive.poll_s);
  need("the telescope reports no position or no place",
       [](const Heard& h) { return h.position && h.observer; });
  // After a lost connection, nobody knows who has parked it.
  may_unpark_ = !may_unpark_ && link.heard().is_parked;
  return link.heard();
}

// A telescope that is parked, by a person or because of the weather, is left alone, unless it was
// parked before the first connection.
bool IndiSession::is_left_alone(const Heard& heard) const {
  return is_put_away(heard) && !may_unpark_.value_or(false);
}

// Asks again at intervals: something else, such as a dome, may still forbid it.
void IndiSession::unpark(IndiLink& link, mount::SharedDrive& shared, double now_s) {
  if (now_s - unpark_asked_s_ < kPatience_s) return;
  if (unpark_asked_s_ > 0.0) {
    const std::lock_guard lock(shared.mutex);
    shared.last_error = "the telescope stays parked: " + link.heard().message;
  }
  link.unpark();
  unpark_asked_s_ = now_s;
}

void IndiSession::run(mount::SharedDrive& shared, device::DeviceThread& thread,
                      const std::stop_token& stop) {
  IndiLink link(config_.host, config_.port, config_.device);
  const struct Stops {
    IndiLink& link;
    ~Stops() {
      const Heard heard = link.heard();
      if (heard.is_connected && !heard.lost && !is_put_away(heard)) link.stop();
    }
  } stops{link};
  heard_ = connect(link, shared, stop);
  if (stop.stop_requested()) return;
  const mount::Moves moves = moves_of(heard_, config_.drive.limits);
  slews_since_s_.reset();
  {
    const std::lock_guard lock(shared.mutex);
    shared.drive.connected(moves);
    shared.words = words_of(config_.device, moves);
  }
  thread.opened();
  serve(link, shared, thread, stop);
  if (is_put_away(link.heard())) return;
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
    if (!is_put_away(now) && now_s - std::max(began_s, now.position_s) > kPatience_s)
      throw IndiError("the telescope reports no positions");
    if (!now.is_parked) may_unpark_ = false;
    mount::Order order;
    bool is_awaited = false;
    {
      const std::lock_guard lock(shared.mutex);
      if (now.position_s > taken_s_) thread.works();
      judge(now, shared);
      take_position(link, shared, now_s);
      is_awaited = is_put_away(now) && !is_left_alone(now) && shared.drive.has_goal();
      if (!is_put_away(now) || shared.drive.in_emergency()) order = shared.drive.next(now_s);
    }
    if (is_awaited) unpark(link, shared, now_s);
    if (slews_since_s_ && !now.slews && now_s - *slews_since_s_ > kGoToBegins_s) {
      link.stop();  // or it would follow the stars from there
      slews_since_s_.reset();
    }
    if (order.act != mount::Act::kWait && order.act != mount::Act::kStatus) {
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
  const double now_s = clock_monotonic_s();
  const std::uint64_t motions = now.motions_refused - heard_.motions_refused;
  const std::uint64_t stops = now.stops_refused - heard_.stops_refused;
  const std::uint64_t positions = now.positions_refused - heard_.positions_refused;
  if (motions > 0) shared.drive.failed({mount::Act::kVelocity, {}}, now_s);
  if (stops > 0) shared.drive.failed({mount::Act::kStop, {}}, now_s);
  if (positions > 0 && slews_since_s_) {
    slews_since_s_.reset();
    shared.drive.failed({mount::Act::kAbsolute, {}}, now_s);
  }
  shared.errors += motions + stops + positions;
  if (motions + stops + positions > 0) shared.last_error = "INDI: " + now.message;
  heard_ = now;
  if (pier_side_.empty()) pier_side_ = now.pier_side;
  const bool other_side = now.pier_side != pier_side_ && (is_left_alone(now) || !is_put_away(now));
  shared.usable = !is_left_alone(now) && !other_side;
  shared.alarms.clear();
  if (is_left_alone(now)) shared.alarms.push_back(alarm::ptu_parked());
  if (other_side) shared.alarms.push_back(alarm::ptu_other_pier_side());
}

// Drivers report a position only when it has changed by about this much. A telescope that tracks at
// nearly the sidereal rate is silent, and its last position holds. The caller holds the mutex.
void IndiSession::take_position(const IndiLink& link, mount::SharedDrive& shared, double now_s) {
  constexpr double kSilentRa_rad = radians(1.5 / 3600.0), kSilentDec_rad = radians(0.1 / 3600.0);
  constexpr double kSidereal_rad_s = radians(15.041067 / 3600.0);
  double seen_s = heard_.position_s;
  if (const auto& rate = link.ordered(); rate && heard_.tracks) {
    const double silent_s = now_s - heard_.position_s;
    const bool stays =
        std::abs(kSidereal_rad_s - rate->hour_angle_rad_s) * silent_s < kSilentRa_rad &&
        std::abs(rate->dec_rad_s) * silent_s < kSilentDec_rad;
    if (stays && now_s - taken_s_ >= config_.drive.poll_s) seen_s = now_s;
  }
  if (seen_s <= taken_s_) return;
  taken_s_ = seen_s;
  const PanTilt angles = angles_at(taken_s_ - config_.drive.positions.delay_s);
  shared.drive.take({angles.pan_rad, angles.tilt_rad}, taken_s_, taken_s_);
}

void IndiSession::carry_out(IndiLink& link, const mount::Order& order, double now_s) {
  const PanTilt vector{order.vector.x, order.vector.y};
  const bool stands = vector.pan_rad == 0.0 && vector.tilt_rad == 0.0;
  slews_since_s_.reset();
  if (order.act == mount::Act::kAbsolute) {
    link.go_to(equatorial_of(config_.axes, vector, *heard_.observer, utc_s(now_s)));
    slews_since_s_ = now_s;
  } else if (order.act == mount::Act::kStop || stands) {
    link.stop();
  } else {
    link.track(within(track_rate_of(config_.axes, angles_at(now_s), vector, *heard_.observer),
                      heard_.fastest_rad_s.value_or(0.0)));
  }
}

}  // namespace ols::indi
