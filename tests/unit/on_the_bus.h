// Makes messages in the form in which the bus delivers them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/bus/bus_inbox.h"

namespace ols {

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

template <class Message>
BusMessage on(const std::string& channel, const Message& message) {
  return {channel, encoded(message)};
}

template <class Message>
Message made() {
  Message message{};
  message.schema_version = Message::SCHEMA_VERSION;
  return message;
}

}  // namespace ols
