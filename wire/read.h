// Reads a message of the bus. Only this file decides whether the bytes are a complete message of
// the known schema, on the channel of the station that the message names. Whether the values are
// plausible is for the callers to judge.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "base/bus/channel_names.h"
#include "base/bus/lcm_bus.h"

namespace ols::wire {

enum class Unread { kMalformed, kSchema, kOtherStation };

// Reads a message that arrived on channel `on`. `channel`: the channel on which it must arrive; if
// the message names a station, a prefix such as kStatusChannel, to which the station's name is
// added.
template <class Message>
std::variant<Message, Unread> read(std::string_view channel, std::string_view on, const void* data,
                                   int bytes) {
  Message message{};
  if (!decode_exactly(data, bytes, message)) return Unread::kMalformed;
  if (message.schema_version != Message::SCHEMA_VERSION) return Unread::kSchema;
  std::string expected(channel);
  if constexpr (requires {
                  { message.station } -> std::same_as<std::string&>;
                }) {
    if (message.station.empty() && channel.ends_with('_')) return Unread::kOtherStation;
    expected += message.station;
  }
  if (on != expected) return Unread::kOtherStation;
  return message;
}

// As the function above; nullopt if the message cannot be read.
template <class Message>
std::optional<Message> read(std::string_view channel, const BusMessage& message) {
  // The channel is checked first, because most messages are on other channels, and decoding them
  // all would cost too much.
  if (!message.channel.starts_with(channel)) return std::nullopt;
  auto found = read<Message>(channel, message.channel, message.payload.data(),
                             static_cast<int>(message.payload.size()));
  auto* const content = std::get_if<Message>(&found);
  return content ? std::optional(std::move(*content)) : std::nullopt;
}

}  // namespace ols::wire
