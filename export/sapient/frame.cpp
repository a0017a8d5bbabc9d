#include "export/sapient/frame.h"

namespace ols::exports {

std::string framed(const std::string& message) {
  std::string bytes;
  bytes.reserve(kFrameHead_bytes + message.size());
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<char>(message.size() >> shift & 0xffU));
  }
  return bytes.append(message);
}

std::optional<std::size_t> framed_length(std::string_view bytes) {
  if (bytes.size() < kFrameHead_bytes) return std::nullopt;
  std::size_t length = 0;
  for (std::size_t i = kFrameHead_bytes; i-- > 0;) {
    length = length << 8U | static_cast<std::uint8_t>(bytes[i]);
  }
  return length;
}

}  // namespace ols::exports
