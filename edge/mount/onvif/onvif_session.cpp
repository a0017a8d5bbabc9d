#include "edge/mount/onvif/onvif_session.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <mutex>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "edge/device/password_file.h"

namespace ols::onvif {
namespace {

using mount::Act;

constexpr double kTurn_s = 0.005;     // between checks whether to ask something
constexpr double kPatience_s = 10.0;  // without a position, before the camera is connected anew

Request request_of(const mount::Order& order, const Learnt& learnt, double lease_s) {
  const std::string& profile = learnt.profile.token;
  if (const auto& timeout = learnt.options.timeout)
    lease_s = std::clamp(lease_s, timeout->min, timeout->max);
  switch (order.act) {
    case Act::kStop:
      return stop(profile);
    case Act::kVelocity:
      return continuous_move(profile, order.vector, lease_s);
    case Act::kAbsolute:
      return absolute_move(profile, order.vector);
    case Act::kStatus:
    case Act::kWait:
      break;
  }
  return get_status(profile);
}

std::string words_of(const Learnt& learnt, const std::optional<double>& clock_ahead_s) {
  const DeviceInformation& device = learnt.device;
  std::string text = device.name.empty() ? "ONVIF" : "ONVIF " + device.name;
  if (!device.serial.empty()) text += ", serial " + device.serial;
  const PtzOptions& options = learnt.options;
  text += ": moves";
  if (options.absolute) text += " absolute";
  if (options.relative) text += " relative";
  if (options.continuous) text += " continuous";
  if (options.zoom) text += ", zoom";
  if (clock_ahead_s) {
    std::array<char, 60> clock{};
    std::snprintf(clock.data(), clock.size(), ", clock %+.0f s", *clock_ahead_s);
    text += clock.data();
  }
  return text;
}

}  // namespace

OnvifSession::~OnvifSession() {
  if (!owes_stop_) return;
  try {
    OnvifLink link({config_.timeout_s, config_.pinned_key}, config_.url,
                   {config_.user, device::read_password(config_.password_file)});
    link.stop_first(*access_);
  } catch (const std::exception&) {  // out of reach: only its time-out can stop it
  }
}

// Breaks off the exchange under way: the stop goes over a new connection.
void OnvifSession::interrupt() {
  const std::lock_guard lock(mutex_);
  if (link_ != nullptr) link_->http().interrupt();
}

void OnvifSession::publish(OnvifLink* open) {
  const std::lock_guard lock(mutex_);
  link_ = open;
}

void OnvifSession::run(mount::SharedDrive& shared, device::DeviceThread& thread,
                       const std::stop_token& stop) {
  const std::string password = device::read_password(config_.password_file);
  OnvifLink open({config_.timeout_s, config_.pinned_key}, config_.url, {config_.user, password});
  const struct Published {
    OnvifSession& session;
    ~Published() { session.publish(nullptr); }
  } published{*this};
  publish(&open);
  try {
    serve(open, shared, thread, stop);
  } catch (const Interrupted&) {  // nothing was ordered yet: begins again
  } catch (const LoginRefused&) {
    access_.reset();
    owes_stop_ = false;
    {
      const std::lock_guard lock(shared.mutex);
      shared.fault = alarm::ptu_login_refused(device::kLoginPause_s / 60.0);
      ++shared.counters["ptu_logins_refused"];
    }
    device::wait_for_other_password(config_.password_file, password, [&](double seconds) {
      shared.pause(seconds, stop);
      return !stop.stop_requested();
    });
    const std::lock_guard lock(shared.mutex);
    shared.fault.reset();
    throw;
  }
}

void OnvifSession::serve(OnvifLink& open, mount::SharedDrive& shared, device::DeviceThread& thread,
                         const std::stop_token& stop) {
  if (access_) open.stop_first(*access_);
  const Learnt learnt = open.learn(config_.profile);
  access_ = open.access(learnt.profile);
  owes_stop_ = true;
  {
    const std::lock_guard lock(shared.mutex);
    shared.words = words_of(learnt, open.clock_ahead_s());
    shared.serial = learnt.device.serial;
    shared.drive.connected(learnt.options);
  }
  if (!learnt.options.continuous && !learnt.options.absolute)
    throw AnswerError("the camera offers no moves of pan and tilt");
  const double began_s = clock_monotonic_s();
  while (!stop.stop_requested()) {
    std::unique_lock lock(shared.mutex);
    const double now_s = clock_monotonic_s();
    const mount::Order order = shared.drive.next(now_s);
    const bool silent = now_s - shared.drive.last_position_s().value_or(began_s) > kPatience_s;
    const std::string why = shared.last_error;
    lock.unlock();
    if (silent) throw AnswerError(why.empty() ? "the camera reports no positions" : why);
    if (order.act == Act::kWait) {
      shared.pause(kTurn_s, stop);
    } else {
      carry_out(open, learnt, order, shared, thread);
    }
  }
  open.http().resume();
  open.ask_ptz(onvif::stop(learnt.profile.token));
  owes_stop_ = false;
}

void OnvifSession::carry_out(OnvifLink& open, const Learnt& learnt, const mount::Order& order,
                             mount::SharedDrive& shared, device::DeviceThread& thread) {
  const Request request = request_of(order, learnt, config_.drive.lease_s);
  OnvifLink::Exchange exchange;
  PtzStatus status;
  std::string error;
  try {
    exchange = open.ask_ptz(request);
    if (order.act == Act::kStatus) {
      status = onvif::status(exchange.answer);
    } else {
      check_done(exchange.answer, request.name());
    }
  } catch (const Interrupted&) {
    open.http().resume();
    return;
  } catch (const AnswerError& refused) {
    error = refused.what();
  }
  const std::lock_guard lock(shared.mutex);
  const double now_s = clock_monotonic_s();
  ++shared.orders;
  if (!error.empty()) {
    ++shared.errors;
    shared.last_error = error;
    shared.drive.failed(order, now_s);
    return;
  }
  ++shared.counters["ptu_replies"];
  if (order.act != Act::kStatus) return shared.drive.done(order, now_s);
  shared.drive.take(status, exchange.sent_s, exchange.answered_s);
  if (!thread.link().is_open) thread.opened();
  thread.works();
}

}  // namespace ols::onvif
