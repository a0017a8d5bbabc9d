#include "wire/orders.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/bus/message_stamp.h"
#include "base/text/plain_text.h"
#include "ols_msg/command_reply_t.hpp"
#include "ols_msg/cue_order_t.hpp"
#include "ols_msg/designate_t.hpp"
#include "ols_msg/lens_command_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/record_t.hpp"
#include "wire/read.h"
#include "wire/station_status.h"

namespace ols::wire {
namespace {

using Ptu = ols_msg::ptu_command_t;

constexpr std::array<std::pair<Kind, std::int8_t>, 8> kPtuCommands{
    {{Kind::kPoint, Ptu::COMMAND_POINT},
     {Kind::kStop, Ptu::COMMAND_STOP},
     {Kind::kRelease, Ptu::COMMAND_RELEASE},
     {Kind::kRearm, Ptu::COMMAND_REARM},
     {Kind::kHome, Ptu::COMMAND_HOME},
     {Kind::kReferenceOk, Ptu::COMMAND_REFERENCE_OK},
     {Kind::kRate, Ptu::COMMAND_RATE},
     {Kind::kCentre, Ptu::COMMAND_CENTRE}}};

std::int8_t ptu_command(Kind kind) {
  const auto row =
      std::ranges::find(kPtuCommands, kind, &decltype(kPtuCommands)::value_type::first);
  return row == kPtuCommands.end() ? Ptu::COMMAND_STOP : row->second;
}

// Not a joystick's rates, which come ten times a second.
std::optional<Kind> kind_of(std::int8_t command) {
  for (const auto& [kind, number] : kPtuCommands) {
    if (number == command && kind != Kind::kRate) return kind;
  }
  return std::nullopt;
}

template <class Message>
OrderId id_of(const Message& message) {
  return {message.boot_id, message.sequence};
}

}  // namespace

std::optional<Order> decode_order(const BusMessage& message) {
  if (const auto move = read<ols_msg::ptu_command_t>(kPtuChannel, message)) {
    const auto kind = kind_of(move->command);
    if (!kind) return std::nullopt;
    return Order{.station = move->station,
                 .kind = *kind,
                 .id = id_of(*move),
                 .frame_utime_us = move->frame_utime,
                 .x_px = move->x_px,
                 .y_px = move->y_px,
                 .pan_rad = move->pan_rad,
                 .tilt_rad = move->tilt_rad};
  }
  if (const auto box = read<ols_msg::designate_t>(kDesignateChannel, message)) {
    return Order{.station = box->station,
                 .kind = Kind::kDesignate,
                 .id = id_of(*box),
                 .frame_utime_us = box->frame_utime,
                 .x_px = box->x_px,
                 .y_px = box->y_px,
                 .width_px = box->width_px,
                 .height_px = box->height_px};
  }
  if (const auto record = read<ols_msg::record_t>(kRecordChannel, message)) {
    return Order{.station = record->station,
                 .kind = Kind::kRecord,
                 .id = id_of(*record),
                 .before_s = record->before_s,
                 .after_s = record->after_s,
                 .label = plain_text(record->label)};
  }
  return std::nullopt;
}

std::optional<Reply> decode_reply(const BusMessage& message) {
  using M = ols_msg::command_reply_t;
  auto said = read<M>(kReplyChannel, message);
  if (!said) said = read<M>(kCueReplyChannel, message);
  if (!said) return std::nullopt;
  return Reply{.station = said->station,
               .order = {said->order_boot_id, said->order_sequence},
               .is_accepted = said->accepted != 0,
               .reason = plain_text(said->reason),
               .detail = plain_text(said->detail),
               .is_stopped = is_stopped(said->state)};
}

bool OrderSender::send(LcmBus& bus, const CueOrder& order, std::int64_t utime_us) const {
  ols_msg::cue_order_t message{};
  stamp_message(message, utime_us, boot_id_, order.id.sequence);
  message.lease_s = kLease_s;
  message.cue = order.cue;
  message.allow = order.allow ? 1 : 0;
  message.handover = order.handover;
  return bus.publish(std::string(kCueOrderChannel), message);
}

template <class Message>
void OrderSender::address(Message& message, const Order& order, std::int64_t utime_us) const {
  stamp_message(message, utime_us, boot_id_, order.id.sequence);
  message.station = order.station;
  message.lease_s = lease_s(order);
}

bool OrderSender::send(LcmBus& bus, const Order& order, std::int64_t utime_us) const {
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

}  // namespace ols::wire
