// Makes the message by which a browser receives a picture (docs/console.md). Pure.
#pragma once

#include <cstdint>
#include <string>

#include "base/net/length_prefix.h"
#include "console/received.h"

namespace ols::console {

inline std::int64_t utime_us(const Picture& picture) {
  return picture.header.value("utime_us", std::int64_t{0});
}

// In this order: four bytes with the length of the header, the header as JSON, the picture.
inline std::string message_bytes(const Json& header, const std::string& picture) {
  const std::string text = header.dump(-1, ' ', false, Json::error_handler_t::replace);
  const LengthPrefix prefix = length_prefix(static_cast<std::uint32_t>(text.size()));
  return std::string(prefix.begin(), prefix.end()) + text + picture;
}

}  // namespace ols::console
