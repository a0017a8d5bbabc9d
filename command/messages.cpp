#include "command/messages.h"

#include <algorithm>

#include "base/channel_names.h"
#include "base/message_stamp.h"
#include "base/plain_text.h"
#include "ols_msg/bearing_t.hpp"
#include "ols_msg/cue_order_t.hpp"
#include "ols_msg/designate_t.hpp"
#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/lens_command_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/record_t.hpp"

namespace ols::command {
namespace {

std::int8_t ptu_command(Kind kind) {
  using M = ols_msg::ptu_command_t;
  switch (kind) {
    case Kind::kPoint:
      return M::COMMAND_POINT;
    case Kind::kRelease:
      return M::COMMAND_RELEASE;
    case Kind::kRearm:
      return M::COMMAND_REARM;
    case Kind::kHome:
      return M::COMMAND_HOME;
    case Kind::kReferenceOk:
      return M::COMMAND_REFERENCE_OK;
    case Kind::kRate:
      return M::COMMAND_RATE;
    case Kind::kCentre:
      return M::COMMAND_CENTRE;
    default:
      return M::COMMAND_STOP;
  }
}

// Not a joystick's rates: they come ten times a second.
std::optional<Kind> kind_of(std::int8_t command) {
  for (const Kind kind : {Kind::kPoint, Kind::kStop, Kind::kRelease, Kind::kRearm, Kind::kHome,
                          Kind::kReferenceOk, Kind::kCentre}) {
    if (ptu_command(kind) == command) return kind;
  }
  return std::nullopt;
}

// Whether it is a message of this type and schema, on the channel of its station.
template <class Message>
bool is_heard(const BusMessage& bus_message, std::string_view channel, Message& message) {
  return bus_message.channel.starts_with(channel) && decode_of_schema(bus_message, message) &&
         bus_message.channel == station_channel(channel, message.station);
}

}  // namespace

std::optional<Order> heard_order(const BusMessage& message) {
  ols_msg::ptu_command_t move;
  if (is_heard(message, kPtuChannel, move)) {
    const auto kind = kind_of(move.command);
    if (!kind) return std::nullopt;
    return Order{.station = move.station,
                 .kind = *kind,
                 .frame_utime_us = move.frame_utime,
                 .x_px = move.x_px,
                 .y_px = move.y_px,
                 .pan_rad = move.pan_rad,
                 .tilt_rad = move.tilt_rad};
  }
  ols_msg::designate_t box;
  if (is_heard(message, kDesignateChannel, box)) {
    return Order{.station = box.station,
                 .kind = Kind::kDesignate,
                 .frame_utime_us = box.frame_utime,
                 .x_px = box.x_px,
                 .y_px = box.y_px,
                 .width_px = box.width_px,
                 .height_px = box.height_px};
  }
  ols_msg::record_t record;
  if (is_heard(message, kRecordChannel, record)) {
    return Order{.station = record.station,
                 .kind = Kind::kRecord,
                 .before_s = record.before_s,
                 .after_s = record.after_s,
                 .label = plain_text(record.label)};
  }
  return std::nullopt;
}

std::optional<ols_msg::station_status_t> heard_status(const BusMessage& message) {
  ols_msg::station_status_t status;
  if (!decode_of_schema(message, status)) return std::nullopt;
  // Channel names are printable (base/bus_datagram.h), hence the station's id too.
  if (message.channel != station_channel(kStatusChannel, status.station)) return std::nullopt;
  status.last_error = plain_text(status.last_error);
  for (auto* texts : {&status.device_name, &status.device_text, &status.alarm, &status.reading_name,
                      &status.counter_name}) {
    for (std::string& text : *texts) text = plain_text(text);
  }
  return status;
}

Reply reply_of(const ols_msg::station_status_t& status) {
  using M = ols_msg::station_status_t;
  Reply reply;
  for (std::size_t i = 0; i < status.counter_name.size(); ++i) {
    reply.counters.emplace(status.counter_name[i], status.counter_value[i]);
  }
  reply.last_error = status.last_error;
  reply.boot_id = status.boot_id;
  reply.stopped = status.state == M::STATE_STOPPED || status.state == M::STATE_EMERGENCY;
  return reply;
}

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

std::string software(const ols_msg::station_status_t& status) {
  constexpr std::size_t kLongest = 40;
  const auto named = std::ranges::find(status.device_name, "software");
  if (named == status.device_name.end()) return "-";
  const auto at = static_cast<std::size_t>(named - status.device_name.begin());
  return plain_text(status.device_text[at].substr(0, kLongest));
}

const char* clock_name(std::int8_t state) {
  using M = ols_msg::bearing_t;
  return state == M::CLOCK_SYNCHRONISED     ? "synchronised"
         : state == M::CLOCK_UNSYNCHRONISED ? "unsynchronised"
                                            : "unknown";
}

const char* calibration_name(std::int8_t state) {
  using M = ols_msg::station_status_t;
  switch (state) {
    case M::CALIBRATION_IN_USE:
      return "in use";
    case M::CALIBRATION_REFUSED:
      return "refused";
    case M::CALIBRATION_DOUBTED:
      return "doubted";
    default:
      return "none";
  }
}

std::optional<FusionCues> heard_cues(const BusMessage& message) {
  using M = ols_msg::fusion_status_t;
  M status;
  if (!decode_of_schema(message, status)) return std::nullopt;
  const auto state_of = [](std::int8_t state) {
    return state == M::CUE_WAITING    ? "waiting"
           : state == M::CUE_SEARCHED ? "searched"
           : state == M::CUE_FOUND    ? "found"
                                      : "forbidden";
  };
  FusionCues said;
  for (std::size_t i = 0; i < status.cue_id.size(); ++i) {
    said.cues.push_back({plain_text(status.cue_id[i]), plain_text(status.cue_label[i]),
                         state_of(status.cue_state[i]), status.cue_target_id[i],
                         status.cue_age_s[i], status.cue_latitude_deg[i],
                         status.cue_longitude_deg[i], status.cue_height_m[i],
                         status.cue_horizontal_sd_m[i], status.cue_vertical_sd_m[i]});
  }
  for (std::size_t i = 0; i < status.counter_name.size(); ++i) {
    if (status.counter_name[i] == "cue_orders_refused")
      said.orders_refused = status.counter_value[i];
  }
  return said;
}

bool OrderSender::send(LcmBus& bus, const CueOrder& order, std::int64_t utime_us) {
  ols_msg::cue_order_t message{};
  stamp_message(message, utime_us, boot_id_, ++sequence_);
  message.lease_s = kLease_s;
  message.cue = order.cue;
  message.allow = order.allow ? 1 : 0;
  return bus.publish(std::string(kCueOrderChannel), message);
}

template <class Message>
void OrderSender::address(Message& message, const Order& order, std::int64_t utime_us) {
  stamp_message(message, utime_us, boot_id_, ++sequence_);
  message.station = order.station;
  message.lease_s = lease_s(order);
}

bool OrderSender::send(LcmBus& bus, const Order& order, std::int64_t utime_us) {
  if (order.kind == Kind::kDesignate || order.kind == Kind::kLook) {
    ols_msg::designate_t message;
    address(message, order, utime_us);
    message.frame_utime = order.frame_utime_us;
    message.x_px = order.x_px;
    message.y_px = order.y_px;
    message.width_px = order.width_px;
    message.height_px = order.height_px;
    return bus.publish(station_channel(kDesignateChannel, order.station), message);
  }
  if (order.kind == Kind::kRecord) {
    ols_msg::record_t message;
    address(message, order, utime_us);
    message.event_utime = 0;
    message.before_s = order.before_s;
    message.after_s = order.after_s;
    message.label = order.label;
    return bus.publish(station_channel(kRecordChannel, order.station), message);
  }
  if (order.kind == Kind::kLens) {
    using M = ols_msg::lens_command_t;
    M message;
    address(message, order, utime_us);
    message.command = order.lens_rates ? M::COMMAND_RATE : M::COMMAND_POSITION;
    message.zoom = order.zoom;
    message.focus = order.focus;
    message.iris = order.iris;
    return bus.publish(station_channel(kLensChannel, order.station), message);
  }
  ols_msg::ptu_command_t message;
  address(message, order, utime_us);
  message.command = ptu_command(order.kind);
  message.pan_rad = order.pan_rad;
  message.tilt_rad = order.tilt_rad;
  message.frame_utime = order.frame_utime_us;
  message.x_px = order.x_px;
  message.y_px = order.y_px;
  message.pan_rate_rad_s = order.pan_rate_rad_s;
  message.tilt_rate_rad_s = order.tilt_rate_rad_s;
  return bus.publish(station_channel(kPtuChannel, order.station), message);
}

}  // namespace ols::command
