#include "sim/onvif/onvif_in_hand.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "edge/mount/onvif/soap_answer.h"
#include "sim/onvif/ptz_scale.h"

namespace ols::sim {
namespace {

using mount::Act;

constexpr double kTimeout_s = 2.0, kReconnect_s = 0.2;
constexpr std::int64_t kStart_us = 1'800'000'000'000'000;

}  // namespace

mount::DriveConfig drive_config(const PtzUnitConfig& unit) {
  const auto scale = [&unit](int axis) {
    const double zero = angle_rad(axis, 0.0, unit);
    return mount::AxisScale{zero, angle_rad(axis, 1.0, unit) - zero, full_speed_rad_s(axis, unit)};
  };
  mount::DriveConfig config;
  config.pan = scale(0);
  config.tilt = scale(1);
  if (unit.repeatability_rad > 0.0) config.positions.sd_rad = unit.repeatability_rad;
  return config;
}

OnvifInHand::OnvifInHand(const OnvifConfig& device, const mount::DriveConfig& drive,
                         std::uint64_t seed, double now_s)
    : device_config_(device),
      drive_config_(drive),
      device_(device, seed, now_s),
      drive_(drive),
      random_(seed),
      device_s_(now_s) {
  connect(now_s);
}

void OnvifInHand::set_faults(const PtzFaults& faults, double now_s) {
  device_.set_faults(faults, std::max(now_s, device_s_));
}

void OnvifInHand::order_by_another(const onvif::Request& request, double now_s) {
  device_s_ = std::max(device_s_, now_s);
  ask(request);
}

std::string OnvifInHand::ask(const onvif::Request& request) {
  const std::int64_t utime_us = kStart_us + std::llround(1e6 * device_s_);
  onvif::Token token{{device_config_.user, device_config_.password},
                     fmt::format("{:016}", ++nonce_),
                     utime_us / 1'000'000};
  const auto answer =
      device_.answer({"POST", "/", "", onvif::envelope(request, token)}, device_s_, utime_us);
  return answer ? answer->body : "";
}

// As the product's thread: an answer that cannot be used ends the connection.
void OnvifInHand::connect(double now_s) try {
  device_s_ = std::max(device_s_, now_s);
  const std::string answer = ask(onvif::get_options("motion"));
  if (answer.empty()) return lose(now_s);
  drive_.connected(onvif::options(answer));
  lost_ = false;
} catch (const onvif::AnswerError&) {
  lose(now_s);
}

void OnvifInHand::lose(double now_s) {
  drive_.lost();
  lost_ = true;
  again_s_ = now_s + kReconnect_s;
}

onvif::Request OnvifInHand::request_of(const mount::Order& order) const {
  if (order.act == Act::kStop) return onvif::stop("main");
  if (order.act == Act::kVelocity)
    return onvif::continuous_move("main", order.vector, drive_config_.lease_s);
  if (order.act == Act::kAbsolute) return onvif::absolute_move("main", order.vector);
  return onvif::get_status("main");
}

void OnvifInHand::advance(double now_s) {
  if (now_s < again_s_) return;
  if (pending_) finish(now_s);
  if (lost_) {
    if (wire.cut) return;
    connect(now_s);
    if (lost_) return;
  }
  const mount::Order order = drive_.next(now_s);
  if (order.act != Act::kWait) send(order, now_s);
}

void OnvifInHand::send(const mount::Order& order, double now_s) {
  pending_ = order;
  sent_s_ = now_s;
  answer_.clear();
  again_s_ = now_s + kTimeout_s;
  if (wire.cut) return;
  device_s_ = now_s + way_s();
  answer_ = ask(request_of(order));
  again_s_ = device_s_ + way_s();
}

void OnvifInHand::finish(double now_s) try {
  const mount::Order order = *pending_;
  pending_.reset();
  if (answer_.empty()) {
    lose(now_s);
  } else if (order.act == Act::kStatus) {
    drive_.take(onvif::status(answer_), sent_s_, again_s_);
  } else {
    drive_.done(order, now_s);
  }
} catch (const onvif::AnswerError&) {
  lose(now_s);
}

}  // namespace ols::sim
