#include "edge/mount/onvif/onvif_mount.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <stop_token>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "edge/device/device_thread.h"
#include "edge/device/password_file.h"
#include "edge/mount/onvif/onvif_link.h"
#include "geometry/angles.h"

namespace ols::onvif {
namespace {

constexpr double kFirstPause_s = 0.2, kMaxPause_s = 5.0;
constexpr double kTurn_s = 0.005;     // until it is looked again whether something is to be asked
constexpr double kNoAngles_s = 1.0;   // without a position: an alarm
constexpr double kPatience_s = 10.0;  // without a position: connected anew

Request request_of(const Order& order, const Learnt& learnt, double lease_s) {
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
  std::string text = learnt.device.empty() ? "ONVIF" : "ONVIF " + learnt.device;
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

std::string quality_of(const PositionIntake& intake) {
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), ", answers in %.0f ms, positions +-%.2f deg",
                1e3 * intake.round_trip_s(), degrees(intake.sd_rad()));
  return text.data();
}

}  // namespace

struct OnvifMount::Impl {
  explicit Impl(const OnvifConfig& wanted)
      : config(wanted),
        drive(wanted.drive),
        thread(
            {"ptu", "is being connected", kFirstPause_s, kMaxPause_s, alarm::ptu_no_connection}) {
    thread.start([this](const std::stop_token& stop) { run(stop); });
  }
  ~Impl() { interrupt(); }

  void interrupt() {
    const std::lock_guard lock(mutex);
    if (link != nullptr) link->http().interrupt();
  }

  void run(const std::stop_token& stop);
  void serve(OnvifLink& open, const std::stop_token& stop);
  void carry_out(OnvifLink& open, const Learnt& learnt, const Order& order);
  void pause(double seconds, const std::stop_token& stop);
  void publish(OnvifLink* open);
  bool ready() const;
  void add_facts(device::DeviceReport& report) const;

  const OnvifConfig config;
  mutable std::mutex mutex;  // of all below but the thread
  std::condition_variable_any wake;
  OnvifLink* link = nullptr;
  Drive drive;
  std::string words;
  bool login_refused = false;
  struct {
    std::uint64_t requests = 0, replies = 0, errors = 0, logins_refused = 0;
  } counters;
  std::string last_error;
  device::DeviceThread thread;  // last: it uses the rest
};

void OnvifMount::Impl::publish(OnvifLink* open) {
  const std::lock_guard lock(mutex);
  link = open;
  if (open == nullptr) drive.lost();
}

void OnvifMount::Impl::pause(double seconds, const std::stop_token& stop) {
  std::unique_lock lock(mutex);
  wake.wait_for(lock, stop, std::chrono::duration<double>(seconds), [] { return false; });
}

void OnvifMount::Impl::run(const std::stop_token& stop) {
  const std::string password = device::read_password(config.password_file);
  OnvifLink open({config.timeout_s, config.pinned_key}, config.url, {config.user, password});
  const struct Published {
    Impl& impl;
    ~Published() { impl.publish(nullptr); }
  } published{*this};
  publish(&open);
  try {
    serve(open, stop);
  } catch (const Interrupted&) {  // before anything was ordered: from the beginning
  } catch (const LoginRefused&) {
    const auto note = [this](bool refused) {
      const std::lock_guard lock(mutex);
      login_refused = refused;
      counters.logins_refused += refused ? 1 : 0;
    };
    note(true);
    device::wait_for_other_password(config.password_file, password, [&](double seconds) {
      pause(seconds, stop);
      return !stop.stop_requested();
    });
    note(false);
    throw;
  }
}

void OnvifMount::Impl::serve(OnvifLink& open, const std::stop_token& stop) {
  const Learnt learnt = open.learn(config.profile);
  {
    const std::lock_guard lock(mutex);
    words = words_of(learnt, open.clock_ahead_s());
    drive.connected(learnt.options);
  }
  if (!learnt.options.continuous && !learnt.options.absolute)
    throw AnswerError("the camera offers no moves of pan and tilt");
  const double began_s = clock_monotonic_s();
  while (!stop.stop_requested()) {
    std::unique_lock lock(mutex);
    const double now_s = clock_monotonic_s();
    const Order order = drive.next(now_s);
    const bool silent = now_s - drive.last_position_s().value_or(began_s) > kPatience_s;
    const std::string why = last_error;
    lock.unlock();
    if (silent) throw AnswerError(why.empty() ? "the camera reports no positions" : why);
    if (order.act == Act::kWait) {
      pause(kTurn_s, stop);
    } else {
      carry_out(open, learnt, order);
    }
  }
  open.http().resume();
  open.ask_ptz(onvif::stop(learnt.profile.token));
}

void OnvifMount::Impl::carry_out(OnvifLink& open, const Learnt& learnt, const Order& order) {
  const Request request = request_of(order, learnt, config.drive.lease_s);
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
  const std::lock_guard lock(mutex);
  const double now_s = clock_monotonic_s();
  ++counters.requests;
  if (!error.empty()) {
    ++counters.errors;
    last_error = error;
    drive.failed(order, now_s);
    return;
  }
  ++counters.replies;
  if (order.act != Act::kStatus) return drive.done(order, now_s);
  drive.take(status, exchange.sent_s, exchange.answered_s);
  if (!thread.link().is_open) thread.opened();
  thread.works();
}

bool OnvifMount::Impl::ready() const {
  return !login_refused && link != nullptr && drive.has_position() && thread.link().is_open;
}

void OnvifMount::Impl::add_facts(device::DeviceReport& report) const {
  const PositionIntake& intake = drive.intake();
  report.readings = {{"ptu_round_trip_s", intake.round_trip_s()},
                     {"ptu_position_sd_deg", degrees(intake.sd_rad())}};
  if (intake.interval_s() > 0.0) report.readings["ptu_interval_s"] = intake.interval_s();
  const Drive::Counters& seen = drive.counters();
  report.counters = {{"ptu_requests", counters.requests},
                     {"ptu_replies", counters.replies},
                     {"ptu_errors", counters.errors},
                     {"ptu_emergencies", seen.emergencies},
                     {"ptu_stops_repeated", seen.stops_repeated},
                     {"ptu_unordered_motions", seen.unordered_motions},
                     {"ptu_orders_ignored", seen.orders_ignored},
                     {"ptu_logins_refused", counters.logins_refused},
                     {"ptu_port_failures", thread.link().failures}};
}

OnvifMount::OnvifMount(const OnvifConfig& config) : impl_(std::make_unique<Impl>(config)) {}
OnvifMount::~OnvifMount() = default;

void OnvifMount::set_goal(const std::optional<mount::Goal>& goal) {
  const std::lock_guard lock(impl_->mutex);
  impl_->drive.set_goal(goal);
}

std::vector<mount::AngleSample> OnvifMount::take_samples() {
  const std::lock_guard lock(impl_->mutex);
  return impl_->drive.take_samples();
}

std::optional<mount::Limits> OnvifMount::limits() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->ready() ? std::optional(impl_->drive.limits()) : std::nullopt;
}

// What is on its way is broken off: the stop goes over a new connection.
void OnvifMount::emergency_halt() {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->drive.emergency_halt();
  }
  impl_->interrupt();
}

void OnvifMount::clear_emergency() {
  const std::lock_guard lock(impl_->mutex);
  impl_->drive.clear_emergency();
}

mount::Reference OnvifMount::reference() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->ready() ? mount::Reference::kTrusted : mount::Reference::kUnknown;
}

device::DeviceReport OnvifMount::report() const {
  const Impl& impl = *impl_;
  device::DeviceReport report = impl.thread.report();
  const double now_s = clock_monotonic_s();
  const std::lock_guard lock(impl.mutex);
  report.last_good_s = impl.drive.last_position_s();
  report.errors += impl.counters.errors;
  if (!impl.last_error.empty()) report.last_error = impl.last_error;
  for (Alarm& alarm : impl.drive.alarms(now_s)) report.alarms.push_back(std::move(alarm));
  if (impl.login_refused) {
    report.state = device::DeviceState::kFault;
    report.alarms = {alarm::ptu_login_refused(device::kLoginPause_s / 60.0)};
    report.text = report.alarms.front().text;
  } else if (report.state == device::DeviceState::kOk) {
    report.text = impl.words + quality_of(impl.drive.intake());
    if (now_s - report.last_good_s.value_or(0.0) > kNoAngles_s)
      report.alarms.push_back(alarm::ptu_no_angles());
  }
  impl.add_facts(report);
  return report;
}

}  // namespace ols::onvif
