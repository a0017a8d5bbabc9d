// Wraps arbitrary bytes as a message that LcmBus can publish.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

namespace ols::sim {

struct RawMessage {
  std::vector<std::uint8_t> data;

  // NOLINTNEXTLINE(readability-identifier-naming): the names that LCM's publish() calls
  int getEncodedSize() const { return static_cast<int>(data.size()); }
  int encode(void* buffer, int offset, int room) const {
    const int size = getEncodedSize();
    if (size > room) return -1;
    if (size > 0)
      std::memcpy(static_cast<std::uint8_t*>(buffer) + offset, data.data(), data.size());
    return size;
  }
};

}  // namespace ols::sim
