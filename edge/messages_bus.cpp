#include "edge/messages_bus.h"

#include <cmath>

namespace ols {

StationBus::StationBus(const StationSettings& settings, std::int64_t boot_id, Station& station)
    : settings_(settings), station_(station), bus_(settings.lcm_url) {
  sender_.station = settings.id;
  sender_.boot_id = boot_id;
  on_command<ols_msg::designate_t>(
      "DESIGNATE",
      [this](const ols_msg::designate_t& message) {
        return station_.designate(from_message(message, sender_), now_s_);
      },
      [](const ols_msg::designate_t&) { return false; });
  on_command<ols_msg::slew_t>(
      "SLEW",
      [this](const ols_msg::slew_t& message) {
        return station_.slew(from_message(message, sender_, now_s_), now_s_);
      },
      [](const ols_msg::slew_t&) { return false; });
  // A stop is good at any age and from any clock: only what moves must be fresh.
  on_command<ols_msg::ptu_command_t>(
      "PTU", [this](const ols_msg::ptu_command_t& message) { return command_ptu(message); },
      [](const ols_msg::ptu_command_t& message) {
        return message.command == ols_msg::ptu_command_t::COMMAND_STOP;
      });
}

Refusal StationBus::command_ptu(const ols_msg::ptu_command_t& message) {
  switch (message.command) {
    case ols_msg::ptu_command_t::COMMAND_POINT:
      return station_.point(from_message(message), now_s_);
    case ols_msg::ptu_command_t::COMMAND_STOP:
      station_.stop(now_s_);
      return Refusal::kNone;
    case ols_msg::ptu_command_t::COMMAND_RELEASE:
      return station_.release(now_s_);
    case ols_msg::ptu_command_t::COMMAND_REARM:
      return station_.rearm(now_s_);
    default:
      refuse("PTU", "unknown_command");
      return Refusal::kNone;
  }
}

template <class Message>
void StationBus::on_command(const std::string& kind,
                            const std::function<Refusal(const Message&)>& execute,
                            const std::function<bool(const Message&)>& passes) {
  gates_.emplace(kind, CommandGate(settings_.gate));
  const auto receive = [this, kind, execute, passes](const std::string&, const void* data,
                                                     int bytes) {
    Message message;
    if (!decode_exactly(data, bytes, message)) return refuse(kind, "malformed");
    if (message.schema_version != Message::SCHEMA_VERSION) return refuse(kind, "schema");
    if (message.station != settings_.id) return refuse(kind, "other_station");
    if (!passes(message)) {
      const auto refusal = gates_.at(kind).admit(stamp_of(message), sender_.utime_us(now_s_));
      if (refusal) return refuse(kind, to_string(*refusal));
    }
    const Refusal result = execute(message);
    if (result != Refusal::kNone) trouble(kind + " refused: " + to_string(result));
  };
  bus_.subscribe("OLS_" + kind + "_" + settings_.id, receive);
}

void StationBus::refuse(const std::string& kind, const std::string& why) {
  counters_["messages_refused"] += 1;
  counters_["messages_refused_" + why] += 1;
  trouble(kind + " refused: " + why);
}

void StationBus::trouble(const std::string& what) {
  last_refusal_ = what;
  ++refusals_;
}

void StationBus::set_time(double monotonic_s, std::int64_t utime_us) {
  now_s_ = monotonic_s;
  sender_.utc_minus_monotonic_us = utime_us - std::llround(monotonic_s * 1e6);
}

void StationBus::receive() { bus_.handle(0); }

void StationBus::send(const Bearing& bearing) {
  bus_.publish("OLS_BEARING_" + settings_.id,
               to_message(bearing, sender_, settings_, ++sequences_["bearing"]));
}

void StationBus::send_status(StationSnapshot snapshot, const PtuLimits& limits,
                             const std::vector<DeviceReport>& devices,
                             const std::string& last_error) {
  snapshot.counters.insert(counters_.begin(), counters_.end());
  auto message =
      to_message(snapshot, sender_, settings_, limits, devices, now_s_, ++sequences_["status"]);
  if (last_error != last_error_) last_error_utime_ = message.utime;
  last_error_ = last_error;
  message.last_error = last_error;
  message.last_error_utime = last_error.empty() ? 0 : last_error_utime_;
  bus_.publish("OLS_STATUS_" + settings_.id, message);
}

void StationBus::send_preview(const Frame& frame, const std::optional<cv::Rect2d>& box) {
  const auto message = to_preview(frame, box, sender_, ++sequences_["preview"]);
  if (message) {
    bus_.publish("OLS_PREVIEW_" + settings_.id, *message);
  } else {
    counters_["previews_too_large"] += 1;
  }
}

}  // namespace ols
