// Messages as the bus brings them.
#pragma once

#include <string>

#include "base/bus_inbox.h"

namespace ols::console::test {

template <class Message>
BusMessage on(const std::string& channel, const Message& content) {
  BusMessage message;
  message.channel = channel;
  message.payload.resize(static_cast<std::size_t>(content.getEncodedSize()));
  content.encode(message.payload.data(), 0, static_cast<int>(message.payload.size()));
  return message;
}

template <class Message>
Message made() {
  Message message{};
  message.schema_version = Message::SCHEMA_VERSION;
  return message;
}

}  // namespace ols::console::test
