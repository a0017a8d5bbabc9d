// Messages as bytes, as they come from the bus.
#pragma once

#include <cstdint>
#include <vector>

namespace ols::fusion::test {

using Bytes = std::vector<std::uint8_t>;

template <class Message>
Bytes encoded(const Message& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace ols::fusion::test
