// Decodes a message type from the bytes of an earlier version of it, which had fewer fields
// (lcmtypes/README.md). For the generated bindings only. Pure.
#pragma once

#include <cstdint>
#include <vector>

namespace ols_lcm {

// As Message::decode(), for bytes of the earlier version Former. The first `pos` bytes are the
// fingerprint of Former, which the caller has checked. Fields that Former lacks become zero or
// empty.
template <class Former, class Message>
int decode_former(Message& message, const void* buf, int offset, int maxlen, int pos) {
  const int length = Former{}._decodeNoHash(buf, offset + pos, maxlen - pos);
  if (length < 0) return length;
  // Fields are only ever appended. Former's bytes are therefore the beginning of Message's bytes.
  const Message unknown{};
  std::vector<std::uint8_t> rest(static_cast<std::size_t>(unknown._getEncodedSizeNoHash()));
  unknown._encodeNoHash(rest.data(), 0, static_cast<int>(rest.size()));
  const auto* const first = static_cast<const std::uint8_t*>(buf) + offset + pos;
  std::vector<std::uint8_t> bytes(first, first + length);
  bytes.insert(bytes.end(), rest.begin() + Former{}._getEncodedSizeNoHash(), rest.end());
  const int grown = message._decodeNoHash(bytes.data(), 0, static_cast<int>(bytes.size()));
  return grown == static_cast<int>(bytes.size()) ? pos + length : -1;
}

}  // namespace ols_lcm
