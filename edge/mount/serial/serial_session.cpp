#include "edge/mount/serial/serial_session.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/process/clocks.h"
#include "geometry/angles.h"

namespace ols::serial_mount {
namespace {

constexpr double kTurn_s = 0.005;
constexpr double kRead_s = 0.01;
constexpr double kPatience_s = 3.0;  // without an answer, before the line is opened anew

// In the head's counts: a position may be on the other side of a full turn.
mount::Space places(const mount::DriveConfig& drive) {
  const auto span = [](const mount::AxisScale& scale, double min_rad, double max_rad) {
    const auto [low, high] = std::minmax({(min_rad - scale.zero_rad) / scale.per_unit_rad,
                                          (max_rad - scale.zero_rad) / scale.per_unit_rad});
    return mount::Span{low, high};
  };
  const mount::Limits& l = drive.limits;
  return {span(drive.pan, l.pan_min_rad, l.pan_max_rad),
          span(drive.tilt, l.tilt_min_rad, l.tilt_max_rad)};
}

double within_travel(const mount::AxisScale& scale, double position, double min_rad,
                     double max_rad) {
  const double middle_rad = 0.5 * (min_rad + max_rad);
  const double angle_rad = scale.zero_rad + scale.per_unit_rad * position;
  const double near_rad = middle_rad + std::remainder(angle_rad - middle_rad, 2.0 * kPi);
  return (near_rad - scale.zero_rad) / scale.per_unit_rad;
}

}  // namespace

mount::Vector SerialSession::place() const {
  const mount::DriveConfig& d = config_.drive;
  const LineProtocol::Position& at = protocol_->position();
  return {within_travel(d.pan, *at.pan, d.limits.pan_min_rad, d.limits.pan_max_rad),
          within_travel(d.tilt, *at.tilt, d.limits.tilt_min_rad, d.limits.tilt_max_rad)};
}

// Whether every question was answered in time.
bool SerialSession::ask(serial::SerialPort& port) {
  protocol_->restart();
  const auto questions = protocol_->questions();
  const auto answered = [&](std::size_t count) {
    const auto& [pan, tilt] = protocol_->position();
    return count + 1 < questions.size() ? pan.has_value() : pan && tilt;
  };
  for (std::size_t i = 0; i < questions.size(); ++i) {
    port.write(questions[i]);
    const double end_s = clock_monotonic_s() + config_.timeout_s;
    while (!answered(i)) {
      if (clock_monotonic_s() > end_s) return false;
      protocol_->receive(port.read(kRead_s));
    }
  }
  return true;
}

void SerialSession::carry_out(serial::SerialPort& port, const mount::Order& order) {
  if (order.act == mount::Act::kStop) port.write(protocol_->stop());
  if (order.act == mount::Act::kVelocity)
    port.write(protocol_->velocity(order.vector.x, order.vector.y));
  if (order.act == mount::Act::kAbsolute)
    port.write(protocol_->place(order.vector.x, order.vector.y));
}

void SerialSession::run(mount::SharedDrive& shared, device::DeviceThread& thread,
                        const std::stop_token& stop) {
  serial::SerialPort port(config_.device, config_.baud);
  port.write(protocol_->stop());
  {
    mount::Moves moves;
    moves.continuous = mount::Space{{-1.0, 1.0}, {-1.0, 1.0}};
    moves.absolute = places(config_.drive);
    const std::lock_guard lock(shared.mutex);
    shared.drive.connected(moves);
    shared.words = "head on " + config_.device;
  }
  double answered_s = clock_monotonic_s();
  bool works = false;
  while (!stop.stop_requested()) {
    mount::Order order;
    {
      const std::lock_guard lock(shared.mutex);
      order = shared.drive.next(clock_monotonic_s());
    }
    const double sent_s = clock_monotonic_s();
    const bool asked = order.act == mount::Act::kStatus;
    const bool answered = asked && ask(port);
    if (!asked) carry_out(port, order);
    const double now_s = clock_monotonic_s();
    if (answered) answered_s = now_s;
    if (asked && !answered) ++unanswered_;
    {
      const std::lock_guard lock(shared.mutex);
      if (order.act != mount::Act::kWait) ++shared.orders;
      shared.errors = protocol_->garbled() + unanswered_;
      if (answered) shared.drive.take(place(), sent_s, now_s);
      if (!asked && order.act != mount::Act::kWait) shared.drive.done(order, now_s);
    }
    if (answered && !std::exchange(works, true)) thread.opened();
    if (answered) thread.works();
    if (now_s - answered_s > kPatience_s) throw std::runtime_error("the head does not answer");
    if (order.act == mount::Act::kWait) shared.pause(kTurn_s, stop);
  }
  port.write(protocol_->stop());
  port.drain(config_.timeout_s);
}

}  // namespace ols::serial_mount
