#include "base/net/length_prefix.h"

namespace ols {

LengthPrefix length_prefix(std::uint32_t length) {
  return {static_cast<std::uint8_t>(length >> 24U), static_cast<std::uint8_t>(length >> 16U),
          static_cast<std::uint8_t>(length >> 8U), static_cast<std::uint8_t>(length)};
}

std::optional<std::uint32_t> message_length(const LengthPrefix& prefix, std::uint32_t max_bytes) {
  std::uint32_t length = 0;
  for (const std::uint8_t byte : prefix) length = length << 8U | byte;
  if (length == 0 || length > max_bytes) return std::nullopt;
  return length;
}

}  // namespace ols
