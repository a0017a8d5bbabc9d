#include "tools/ctl/operator.h"

#include <algorithm>
#include <utility>

#include "base/boot_id.h"
#include "base/channel_names.h"
#include "base/clocks.h"
#include "tools/ctl/heard_status.h"

namespace ols::ctl {
namespace {

constexpr double kLease_s = 2.0;
constexpr double kTwoIntervals_s = 1.2;  // stations send their status twice a second
constexpr int kPoll_ms = 50;

// The refusal whose counter (`prefix` + reason) has grown; nothing if none has.
std::optional<std::string> new_refusal(const ols_msg::station_status_t& before,
                                       const ols_msg::station_status_t& now,
                                       const std::string& prefix) {
  for (const auto& name : now.counter_name) {
    if (!name.starts_with(prefix) || counter(now, name) <= counter(before, name)) continue;
    const std::string why = name.substr(prefix.size());
    if (why == "just_stopped") return "refused: it was stopped less than a second ago; try again";
    // With the station's explanation if there is one ("RECORD refused: disk full").
    return "refused: " + why +
           (now.last_error != before.last_error ? " (" + now.last_error + ")" : "");
  }
  return std::nullopt;
}

}  // namespace

double counter(const ols_msg::station_status_t& status, const std::string& name) {
  for (std::size_t i = 0; i < status.counter_name.size(); ++i) {
    if (status.counter_name[i] == name) return status.counter_value[i];
  }
  return 0.0;
}

const char* state_name(std::int8_t state) {
  using M = ols_msg::station_status_t;
  switch (state) {
    case M::STATE_IDLE:
      return "idle";
    case M::STATE_MANUAL:
      return "manual";
    case M::STATE_TRACKING:
      return "tracking";
    case M::STATE_COASTING:
      return "coasting";
    case M::STATE_LOST:
      return "lost";
    case M::STATE_SLEWED:
      return "slewed";
    case M::STATE_STOPPED:
      return "stopped";
    case M::STATE_EMERGENCY:
      return "emergency";
    default:
      return "unknown";
  }
}

const char* device_name(std::int8_t device) {
  using M = ols_msg::station_status_t;
  switch (device) {
    case M::DEVICE_ABSENT:
      return "absent";
    case M::DEVICE_STARTING:
      return "starting";
    case M::DEVICE_OK:
      return "ok";
    case M::DEVICE_FAULT:
      return "fault";
    default:
      return "unknown";
  }
}

const char* device_state(const ols_msg::station_status_t& status, const std::string& name) {
  for (std::size_t i = 0; i < status.device_name.size(); ++i) {
    if (status.device_name[i] == name) return device_name(status.device_state[i]);
  }
  return "-";
}

Operator::Operator(const std::string& lcm_url, std::string station)
    : station_(std::move(station)), bus_(lcm_url), boot_id_(draw_boot_id()) {
  const std::string which = station_ == "all" ? ".*" : station_;
  bus_.subscribe(station_channel(kStatusChannel, which),
                 [this](const BusMessage& message) { hear(message); });
}

void Operator::hear(const BusMessage& message) {
  auto status = heard_status(message);
  if (!status) return;
  // Any station counts as heard, even if the table is full.
  if (stopping_) publish_ptu(status->station, ols_msg::ptu_command_t::COMMAND_STOP, 0.0, 0.0);
  if (!statuses_.contains(status->station) && statuses_.size() >= kMostStationsHeard) return;
  statuses_[status->station] = std::move(*status);
}

const Operator::Statuses& Operator::listen(double timeout_s) {
  const double start_s = clock_monotonic_s();
  const bool all = station_ == "all";
  const double end_s = start_s + (all ? kTwoIntervals_s : timeout_s);
  while (clock_monotonic_s() < end_s && (all || statuses_.empty())) bus_.handle(kPoll_ms);
  return statuses_;
}

template <class Message>
void Operator::address(Message& message, const std::string& station) {
  message.utime = clock_utime_us();
  message.schema_version = Message::SCHEMA_VERSION;
  message.boot_id = boot_id_;
  message.sequence = ++sequence_;
  message.station = station;
  message.lease_s = kLease_s;
}

std::optional<std::string> Operator::outcome(const std::string& station,
                                             const std::string& command) {
  const ols_msg::station_status_t before = statuses_[station];
  const double end_s = clock_monotonic_s() + kLease_s;
  while (clock_monotonic_s() < end_s) {
    bus_.handle(kPoll_ms);
    const ols_msg::station_status_t& now = statuses_[station];
    if (counter(now, command + "_accepted") > counter(before, command + "_accepted")) {
      return std::nullopt;
    }
    if (auto refusal = new_refusal(before, now, "refused_")) return refusal;
  }
  // These also count messages of other senders: used only if nothing else is known.
  return new_refusal(before, statuses_[station], "messages_refused_").value_or("no answer");
}

std::optional<std::string> Operator::designate(const std::string& station, double x, double y,
                                               double width, double height) {
  ols_msg::designate_t message;
  address(message, station);
  message.frame_utime = 0;
  message.x_px = x;
  message.y_px = y;
  message.width_px = width;
  message.height_px = height;
  bus_.publish(station_channel(kDesignateChannel, station), message);
  return outcome(station, "designate");
}

void Operator::publish_ptu(const std::string& station, std::int8_t command, double pan_rad,
                           double tilt_rad) {
  ols_msg::ptu_command_t message;
  address(message, station);
  message.command = command;
  message.pan_rad = pan_rad;
  message.tilt_rad = tilt_rad;
  bus_.publish(station_channel(kPtuChannel, station), message);
}

std::optional<std::string> Operator::send_ptu(const std::string& station, std::int8_t command,
                                              double pan_rad, double tilt_rad,
                                              const std::string& counter_name) {
  publish_ptu(station, command, pan_rad, tilt_rad);
  return outcome(station, counter_name);
}

bool Operator::says_stopped(const std::string& station, double stops_before) const {
  using M = ols_msg::station_status_t;
  const auto status = statuses_.find(station);
  return status != statuses_.end() && counter(status->second, "stop_accepted") > stops_before &&
         (status->second.state == M::STATE_STOPPED || status->second.state == M::STATE_EMERGENCY);
}

std::map<std::string, bool> Operator::stop(double timeout_s) {
  constexpr double kAgain_s =
      0.02;  // repeated fast: a stop is urgent, and a flooded network loses some
  constexpr double kMostRate = 2000;  // [1/s] of stops to all stations together
  constexpr int kTurn_ms = 10;
  struct Addressed {
    double sent_s = -1.0;
    std::optional<double> stops;  // its first stop count heard: a higher one confirms a stop
    bool stopped = false;
  };
  const bool all = station_ == "all";
  stopping_ = all;
  std::map<std::string, Addressed> addressed;
  if (!all) addressed[station_] = {};
  const double start_s = clock_monotonic_s();
  for (double now_s = start_s; now_s < start_s + timeout_s; now_s = clock_monotonic_s()) {
    for (const auto& [id, status] : statuses_) {
      Addressed& one = addressed[id];
      if (!one.stops) one.stops = counter(status, "stop_accepted");
      one.stopped = says_stopped(id, *one.stops);
    }
    const double again_s = std::max(kAgain_s, static_cast<double>(addressed.size()) / kMostRate);
    for (auto& [id, one] : addressed) {
      if (one.stopped || now_s < one.sent_s + again_s) continue;
      publish_ptu(id, ols_msg::ptu_command_t::COMMAND_STOP, 0.0, 0.0);
      one.sent_s = now_s;
    }
    const bool every =
        std::ranges::all_of(addressed, [](const auto& a) { return a.second.stopped; });
    if (every && !addressed.empty() && (!all || now_s > start_s + kTwoIntervals_s)) break;
    bus_.handle(kTurn_ms);
  }
  stopping_ = false;
  std::map<std::string, bool> result;
  for (const auto& [id, one] : addressed) result[id] = one.stopped;
  return result;
}

std::optional<std::string> Operator::point(const std::string& station, double pan_rad,
                                           double tilt_rad) {
  return send_ptu(station, ols_msg::ptu_command_t::COMMAND_POINT, pan_rad, tilt_rad, "point");
}

std::optional<std::string> Operator::release(const std::string& station) {
  return send_ptu(station, ols_msg::ptu_command_t::COMMAND_RELEASE, 0.0, 0.0, "release");
}

std::optional<std::string> Operator::rearm(const std::string& station) {
  return send_ptu(station, ols_msg::ptu_command_t::COMMAND_REARM, 0.0, 0.0, "rearm");
}

std::optional<std::string> Operator::home(const std::string& station) {
  return send_ptu(station, ols_msg::ptu_command_t::COMMAND_HOME, 0.0, 0.0, "home");
}

std::optional<std::string> Operator::reference_ok(const std::string& station) {
  return send_ptu(station, ols_msg::ptu_command_t::COMMAND_REFERENCE_OK, 0.0, 0.0, "reference_ok");
}

std::optional<std::string> Operator::record(const std::string& station, double before_s,
                                            double after_s, const std::string& label) {
  ols_msg::record_t message;
  address(message, station);
  message.event_utime = 0;
  message.before_s = before_s;
  message.after_s = after_s;
  message.label = label;
  bus_.publish(station_channel(kRecordChannel, station), message);
  return outcome(station, "record");
}

}  // namespace ols::ctl
